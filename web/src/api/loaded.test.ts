import { describe, expect, it, vi } from 'vitest';
import { Refused, Unreachable } from './client';
import { Loaded } from './loaded.svelte';

const MISSING = new Refused(404, { detail: 'There is no such run.' });
const aborted = (): DOMException => new DOMException('', 'AbortError');

describe('a loaded value', () => {
  it('is null until it is there', async () => {
    const loaded = new Loaded(() => Promise.resolve(7));
    expect(loaded.value).toBeNull();
    expect(await loaded.load()).toBe(true);
    expect([loaded.value, loaded.problem, loaded.status]).toEqual([7, null, null]);
  });

  it('stays while the next one cannot be loaded, and the problem goes when one can', async () => {
    const fetch = vi.fn<() => Promise<number>>().mockResolvedValueOnce(1).mockRejectedValueOnce(MISSING);
    fetch.mockResolvedValue(2);
    const loaded = new Loaded(fetch);
    await loaded.load();
    expect(await loaded.load()).toBe(false);
    expect([loaded.value, loaded.problem, loaded.isMissing]).toEqual([1, 'There is no such run.', true]);
    await loaded.load();
    expect([loaded.value, loaded.problem, loaded.isMissing]).toEqual([2, null, false]);
  });

  it('is the one asked for last, whichever comes last', async () => {
    const arrive: ((value: string) => void)[] = [];
    const loaded = new Loaded(() => new Promise<string>((resolve) => arrive.push(resolve)));
    const both = [loaded.load(), loaded.load()];
    arrive[1]?.('second');
    arrive[0]?.('first');
    await Promise.all(both);
    expect(loaded.value).toBe('second');
  });

  it('says nothing of a request that was aborted, nor of one that another replaced', async () => {
    const loaded = new Loaded(() => Promise.reject(aborted()));
    expect(await loaded.load()).toBe(false);
    expect(loaded.problem).toBeNull();
    const failures: ((reason: Error) => void)[] = [];
    const replaced = new Loaded(() => new Promise((_, reject) => failures.push(reject)));
    const [first] = [replaced.load(), replaced.load()];
    failures[0]?.(MISSING);
    await first;
    expect(replaced.problem).toBeNull();
  });

  it('promises another attempt only where there is one', async () => {
    const fail = (): Promise<never> => Promise.reject(new Unreachable('refused'));
    const [once, live] = [new Loaded(fail), new Loaded(fail, { live: true })];
    await Promise.all([once.load(), live.load()]);
    expect(once.problem).toBe('The server cannot be reached.');
    expect(live.problem).toContain('tries again automatically');
    expect([once.status, live.status]).toEqual([null, null]);
  });
});

describe('a change', () => {
  it('is followed by loading again', async () => {
    let stored = 1;
    const loaded = new Loaded(() => Promise.resolve(stored));
    await loaded.load();
    expect(await loaded.change(() => Promise.resolve((stored = 2)))).toBe(true);
    expect(loaded.value).toBe(2);
  });

  it('that is refused leaves the value and says why', async () => {
    const loaded = new Loaded(() => Promise.resolve(1));
    await loaded.load();
    const refused = new Refused(409, { detail: 'That is the last administrator.' });
    expect(await loaded.change(() => Promise.reject(refused))).toBe(false);
    expect([loaded.value, loaded.problem, loaded.status]).toEqual([
      1,
      'That is the last administrator.',
      409,
    ]);
  });

  it('that was lost on its way may or may not be saved', async () => {
    const loaded = new Loaded(() => Promise.resolve(1));
    expect(await loaded.change(() => Promise.reject(new Unreachable()))).toBe(false);
    expect(loaded.problem).toContain('may not be saved');
  });
});
