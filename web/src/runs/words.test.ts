// @vitest-environment happy-dom
import { flushSync, mount, unmount } from 'svelte';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { api } from '../api/client';
import type { Costs, Me, Run, RunList as Runs } from '../api/types';
import { shell } from '../ui/shell.svelte';
import LiveMark from './LiveMark.svelte';
import RunList from './RunList.svelte';
import Tiles from './Tiles.svelte';

vi.mock('../api/live', () => ({ throttled: (call: () => void) => call, watchAll: () => () => undefined }));

const RUN = {
  ...{ id: 'r', name: 'a run', algorithm: 'h-bc', seed: 0, state: 'running', priority: 0, vocabulary: {} },
  ...{ episodes: null, episodes_done: 0, success_rate: null, budget: null, created_at: 0, open_queries: 1 },
  ...{ spent: 1, reserved: 1 },
} as unknown as Run;

describe('one thing is not counted as many', () => {
  let shown: Record<string, unknown> | undefined;
  const text = (): string => document.body.textContent.replaceAll(/\s+/g, ' ');

  beforeEach(() => {
    const found: Runs & { annotators: [] } = { runs: [RUN], total: 1, annotators: [] };
    vi.spyOn(api, 'GET').mockResolvedValue({ data: found, response: new Response() } as never);
  });
  afterEach(async () => {
    if (shown) await unmount(shown);
    shell.me = null;
    vi.restoreAllMocks();
  });

  it('in the list of runs', async () => {
    shown = mount(RunList, { target: document.body });
    await vi.waitFor(() => expect(document.querySelector('[role=status]')?.textContent).toBe('1 run'));
  });

  it('in the numbers of a run', () => {
    const costs = {
      lo_total: 1,
      seconds: 0,
      first_at: { '0.8': { cost: 1, episode: 3 } },
    } as unknown as Costs;
    shown = mount(Tiles, { target: document.body, props: { run: { ...RUN, budget: 1 }, costs, tests: 100 } });
    flushSync();
    expect(text()).not.toContain('unit'); // an annotator does not pay
    shell.me = { role: 'viewer' } as unknown as Me;
    flushSync();
    for (const words of ['of 1 unit', '1 unit reserved', '1 unit on LO labels', '1 unit ep. 3']) {
      expect(text()).toContain(words);
    }
    expect(text()).not.toContain('1 units');
  });
});

describe('a server without runs', () => {
  let shown: Record<string, unknown> | undefined;
  afterEach(async () => {
    if (shown) await unmount(shown);
    shell.me = null;
    vi.restoreAllMocks();
  });

  it.each([
    ['admin', true],
    ['learner', true],
    ['annotator', false],
    ['viewer', false],
  ] as const)('says which command starts one to those who may run it (%s: %s)', async (role, may) => {
    const found: Runs = { runs: [], total: 0 };
    vi.spyOn(api, 'GET').mockResolvedValue({ data: found, response: new Response() } as never);
    shell.me = { role } as unknown as Me;
    shown = mount(RunList, { target: document.body });
    await vi.waitFor(() => expect(document.querySelector('h1')?.textContent).toBe('No runs yet'));
    expect(document.body.textContent.includes('waypost train')).toBe(may);
  });
});

describe('the live mark', () => {
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
});
