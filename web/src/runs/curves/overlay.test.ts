import { describe, expect, it } from 'vitest';
import type { Run } from '../../api/types';
import { bandOf, grouped } from './overlay';

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
