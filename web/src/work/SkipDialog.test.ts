// @vitest-environment happy-dom
import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import SkipDialog from './SkipDialog.svelte';

describe('the skip dialog', () => {
  const onskip = vi.fn();
  let dialog: Record<string, unknown>;
  const open = (): void => {
    dialog = mount(SkipDialog, { target: document.body, props: { onskip, onclose: () => undefined } });
    flushSync();
  };
  const input = (selector: string): HTMLInputElement => {
    const found = document.querySelector<HTMLInputElement>(selector);
    if (!found) throw new Error(selector);
    return found;
  };
  const own = (): HTMLInputElement => input('[type=text]');
  const write = (words: string): void => {
    own().value = words;
    own().dispatchEvent(new Event('input', { bubbles: true }));
    flushSync();
  };
  const choose = (reason: string): void => {
    input(`[value="${reason}"]`).click();
    flushSync();
  };
  const chosen = (): string | undefined =>
    [...document.querySelectorAll<HTMLInputElement>('input[type=radio]')].find((one) => one.checked)?.value;
  const skip = (): void => own().form?.requestSubmit();

  beforeEach(() => {
    onskip.mockReset();
    open();
  });
  afterEach(() => unmount(dialog));

  it('opens with the first reason and no words, whatever was typed before', async () => {
    write('too dark');
    skip();
    await unmount(dialog);
    open();
    expect([chosen(), own().value]).toEqual(['I cannot tell', '']);
    skip();
    expect(onskip.mock.calls.flat()).toEqual(['too dark', 'I cannot tell']);
  });

  it('sends the words and shows no other reason beside them', () => {
    write(' too dark ');
    expect(chosen()).toBeUndefined();
    skip();
    expect(onskip).toHaveBeenCalledExactlyOnceWith('too dark');
  });

  it('drops the words when a reason is chosen after them', () => {
    write('too dark');
    choose('The picture is wrong');
    expect([chosen(), own().value]).toEqual(['The picture is wrong', '']);
    skip();
    expect(onskip).toHaveBeenCalledExactlyOnceWith('The picture is wrong');
  });

  it('goes back to the reason that was chosen when the words are deleted', () => {
    choose('The question is unclear');
    write('too dark');
    write('');
    expect(chosen()).toBe('The question is unclear');
    skip();
    expect(onskip).toHaveBeenCalledExactlyOnceWith('The question is unclear');
  });

  it('lets the browser fill in nothing', () => {
    expect(own().autocomplete).toBe('off');
  });
});
