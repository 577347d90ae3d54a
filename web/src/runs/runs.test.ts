import { describe, expect, it, vi } from 'vitest';
import type { Curves, Query, Run } from '../api/types';
import { stepMaze } from '../maze/steps';
import { buildTape } from '../player/tape';
import { ago, count, percent, seconds } from '../ui/format';
import { acrossOf, bandOf, grouped, joined, stackOf, successOf } from './curves';
import { throttled } from './live';
import { labelsOf, tapeOf } from './replay.svelte';
import { wordsOfEnding } from './words';

function curvesWith(more: Partial<Curves>): Curves {
  const none = {
    hier_demo: [],
    inspect_full: [],
    label_hi: [],
    inspect_lo: [],
    label_lo: [],
    label_full: [],
  };
  return {
    episode: [],
    success_rate: [],
    test_success: [],
    cost: [],
    lo_cost: [],
    seconds: [],
    active_seconds: [],
    cost_by_kind: none,
    hi_labels: [],
    lo_samples: [],
    learner_seconds: [],
    ...more,
  };
}

function runWith(more: Partial<Run>): Run {
  return {
    id: '0',
    name: 'a run',
    algorithm: 'hg-dagger',
    seed: 0,
    config: { preset: 'paper', seed: 0 },
    prices: {},
    episodes: 500,
    state: 'running',
    vocabulary: { domain: 'maze' },
    ...more,
  } as unknown as Run;
}

describe('the curves of a run', () => {
  const curves = curvesWith({
    episode: [0, 1],
    cost: [1, 8],
    success_rate: [null, 0.5],
    cost_by_kind: {
      hier_demo: [0, 0],
      label_lo: [0, 6],
      inspect_full: [1, 2],
      label_hi: [0, 0],
      inspect_lo: [],
      label_full: [],
    },
  });

  it('stack the kinds that cost something, the last of the algorithm on top', () => {
    const layers = stackOf(curves, 'cost');
    expect(layers.map(({ label, x, y, low, high }) => ({ label, x, y, low, high }))).toEqual([
      { label: 'Label_LO', x: [1, 8], y: [0, 6], low: [1, 2], high: [1, 8] },
      { label: 'Inspect_FULL', x: [1, 8], y: [1, 2], low: [0, 0], high: [1, 2] },
    ]);
  });

  it('hold until the next value against anything but episodes', () => {
    expect(successOf(curves, 'episode')[0]?.steps).toBe(false);
    expect(successOf(curves, 'cost')[0]?.steps).toBe(true);
    expect(successOf(curvesWith({ episode: [0], success_rate: [null] }), 'cost')).toEqual([]);
  });

  it('go on where they ended', () => {
    const more = curvesWith({
      episode: [2],
      cost: [9],
      cost_by_kind: { ...curves.cost_by_kind, label_lo: [7] },
    });
    const all = joined(curves, more);
    expect([all.episode, all.cost, all.cost_by_kind.label_lo]).toEqual([
      [0, 1, 2],
      [1, 8, 9],
      [0, 6, 7],
    ]);
    expect(joined(null, more)).toBe(more);
    expect(joined(curves, curvesWith({}))).toBe(curves);
  });

  it('know only their own axes', () => {
    expect([acrossOf('seconds'), acrossOf('__proto__'), acrossOf(null)]).toEqual([
      'seconds',
      'episode',
      'episode',
    ]);
  });
});

describe('runs overlaid', () => {
  it('are one group if they differ only by seed', () => {
    const runs = [
      runWith({ id: 'a', seed: 0 }),
      runWith({ id: 'b', seed: 1, config: { seed: 1, preset: 'paper' } }),
      runWith({ id: 'c', name: 'other', config: { preset: 'lean', seed: 0 } }),
    ];
    const groups = grouped(runs, false);
    expect(groups.map((group) => group.runs.map((run) => run.id))).toEqual([['a', 'b'], ['c']]);
    expect(groups.map((group) => group.label)).toEqual(['hg-dagger, preset paper (2 runs)', 'other']);
    expect(grouped(runs, true).map((group) => group.label)).toEqual(['a run a', 'a run b', 'other']);
  });

  it('are steps: their median and range at each point, to where half of them went', () => {
    const band = bandOf([
      { x: [0, 10], y: [0, 1], over: true },
      { x: [0, 20], y: [0, 0.5], over: false },
      { x: [0, 30], y: [0.2, 0.4], over: false },
    ]);
    expect(band).toEqual({
      x: [0, 10, 20],
      median: [0, 0.2, 0.5],
      low: [0, 0, 0.2],
      high: [0.2, 1, 1],
    });
  });

  it('leave an unfinished run out from its end on, and keep the last value of a finished one', () => {
    const ended = { x: [0, 1], y: [1, 1] };
    const other = { x: [0, 4], y: [0, 0], over: false };
    expect(bandOf([{ ...ended, over: false }, other, other])?.high.at(-1)).toBe(0);
    expect(bandOf([{ ...ended, over: true }, other, other])?.high.at(-1)).toBe(1);
  });

  it('are nothing where none has begun', () => {
    expect(bandOf([])).toBeNull();
    expect(bandOf([{ x: [], y: [], over: false }])).toBeNull();
  });
});

describe('one query', () => {
  const segment = { subgoal: 'north', states: [0, 1, 2, 3], actions: ['up', 'up', 'left'], frames: [] };

  it('shows where the expert would have ended the segment, and no label after that', () => {
    const labels = labelsOf(
      { kind: 'label_lo', actions: ['up', 'down', null], terminations: [false, false, true, false] },
      buildTape([], [segment]),
    );
    expect(labels).toEqual([
      { frame: 0, action: 'up' },
      { frame: 1, action: 'down' },
      { frame: 2, action: null },
    ]);
  });

  it('shows a demonstration on a maze, whose steps the page knows, and elsewhere its start', () => {
    const ask = { kind: 'hier_demo', context: [], state: [5, 2] } as unknown as Query['ask'];
    const segments = [
      { subgoal: 'north', actions: ['up', 'up'] },
      { subgoal: 'east', actions: ['right'] },
    ];
    const query = { ask, answer: { kind: 'hier_demo', segments } } as const;
    expect(tapeOf(query, stepMaze).frames).toEqual([
      [5, 2],
      [4, 2],
      [3, 2],
      [3, 3],
    ]);
    expect(tapeOf(query, null).frames).toEqual([[5, 2]]);
    expect(tapeOf({ ask, answer: null }, stepMaze).frames).toEqual([[5, 2]]);
  });

  it('says how each time it was handed out ended', () => {
    const past = {
      id: 1,
      annotator: 'ann',
      leased_at: 0,
      expires_at: 1,
      ended_at: 1,
      reason: null,
      answer: null,
    };
    const answer = {
      id: 1,
      at: 0,
      units: 1,
      seconds: 1,
      content: { kind: 'inspect_full', verdict: 'fail' },
    } as const;
    expect(wordsOfEnding({ ...past, state: 'skipped', reason: 'too dark' })).toBe('skipped: too dark');
    expect(wordsOfEnding({ ...past, state: 'expired' })).toBe('the lease ran out');
    expect(wordsOfEnding({ ...past, state: 'answered', answer: { ...answer, fate: 'retracted' } })).toBe(
      'answered (✗ fail), then taken back',
    );
    expect(wordsOfEnding({ ...past, state: 'expired', answer: { ...answer, fate: 'late' } })).toBe(
      'answered too late (✗ fail), not charged',
    );
  });
});

describe('live updates', () => {
  it('refresh at once, then at most once in a while, and miss nothing', async () => {
    vi.useFakeTimers();
    const load = vi.fn(() => Promise.resolve());
    const changed = throttled(load, 1000);
    for (let event = 0; event < 9; event++) changed();
    expect(load).toHaveBeenCalledTimes(1);
    await vi.advanceTimersByTimeAsync(1000);
    expect(load).toHaveBeenCalledTimes(2);
    await vi.advanceTimersByTimeAsync(5000);
    expect(load).toHaveBeenCalledTimes(2);
    changed();
    expect(load).toHaveBeenCalledTimes(3);
    vi.useRealTimers();
  });
});

describe('numbers in words', () => {
  it('are short and plain', () => {
    expect([count(1, 'answer'), count(1420, 'unit')]).toEqual(['1 answer', '1,420 units']);
    expect([percent(null), percent(0.845), percent(1)]).toEqual(['–', '84.5%', '100%']);
    expect([3.14, 240, 7500].map(seconds)).toEqual(['3.1 s', '4 min', '2 h 5 min']);
    expect([5, 300, 7200, 200_000].map((passed) => ago(0, passed))).toEqual([
      'just now',
      '5 min ago',
      '2 h ago',
      '2 d ago',
    ]);
  });
});
