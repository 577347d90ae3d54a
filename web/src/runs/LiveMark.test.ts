// @vitest-environment happy-dom
import { flushSync, mount, unmount } from 'svelte';
import { afterEach, expect, it } from 'vitest';
import type { Run } from '../api/types';
import LiveMark from './LiveMark.svelte';

let mark: Record<string, unknown> | undefined;
afterEach(async () => {
  if (mark) await unmount(mark);
});

function shown(state: Run['state'], isLive: boolean): string {
  mark = mount(LiveMark, { target: document.body, props: { state, isLive } });
  flushSync();
  return document.body.textContent.trim();
}

it.each([
  ['running', true, '● live'],
  ['running', false, '○ reconnecting'],
  ['paused', true, '● live'],
  ['paused', false, '○ reconnecting'],
] as const)('a run that is %s says whether its changes arrive (%s)', (state, isLive, words) => {
  expect(shown(state, isLive)).toBe(words);
});

it.each([true, false])(
  'a finished run is not called live, because nothing changes any more (%s)',
  (isLive) => {
    expect(shown('finished', isLive)).toBe('');
  },
);
