// @vitest-environment happy-dom
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { land, landWhenLoaded } from './landing';

const settled = (): Promise<unknown> => new Promise((resolve) => setTimeout(resolve));
const LOADING = '<main aria-busy="true"><h1>Loading</h1></main>';
const LOADED = '<main><h1>Runs</h1><input type="search" /></main>';

describe('the focus, when another view opens,', () => {
  let view: HTMLElement;
  let giveUp = (): void => undefined;
  const focused = (): string | null | undefined => document.activeElement?.textContent;
  const focus = (selector: string): void => document.querySelector<HTMLElement>(selector)?.focus();

  beforeEach(() => {
    document.body.innerHTML = '<a href="/runs">to the runs</a><a href="/me">me</a><div id="content"></div>';
    view = document.querySelector<HTMLElement>('#content') ?? document.body;
    focus('a');
  });
  afterEach(() => giveUp());

  it('goes to the heading, from where Tab continues in the view', () => {
    view.innerHTML = LOADED;
    giveUp = landWhenLoaded(view);
    expect(focused()).toBe('Runs');
  });

  it('waits until the view is loaded', async () => {
    view.innerHTML = LOADING;
    giveUp = landWhenLoaded(view);
    expect(focused()).toBe('to the runs');
    view.innerHTML = LOADED;
    await settled();
    expect(focused()).toBe('Runs');
  });

  it('stays where a person has moved it meanwhile', async () => {
    view.innerHTML = LOADING;
    giveUp = landWhenLoaded(view);
    focus('[href="/me"]');
    view.innerHTML = LOADED;
    await settled();
    expect(focused()).toBe('me');
  });

  it('goes there once: what changes in the view later does not move it', async () => {
    view.innerHTML = LOADED;
    giveUp = landWhenLoaded(view);
    focus('input');
    view.querySelector('main')?.append(document.createElement('h1'));
    await settled();
    expect(document.activeElement?.tagName).toBe('INPUT');
  });

  it('goes nowhere after the view was left', async () => {
    view.innerHTML = LOADING;
    landWhenLoaded(view)();
    view.innerHTML = LOADED;
    await settled();
    expect(focused()).toBe('to the runs');
  });

  it('stays on a link of the view that leads to a part of the same view', () => {
    view.innerHTML = '<main><h1>a run</h1><a href="/runs/a/ledger" aria-current="page">Ledger</a></main>';
    focus('[aria-current]');
    giveUp = landWhenLoaded(view);
    expect(focused()).toBe('Ledger');
  });

  it('goes to the main part where there is no heading yet', () => {
    view.innerHTML = '<main>soon</main>';
    land(view);
    expect(focused()).toBe('soon');
  });
});
