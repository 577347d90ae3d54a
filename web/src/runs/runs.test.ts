import { describe, expect, it, vi } from 'vitest';
import type { Curves } from '../api/types';
import { ago, count, percent, seconds } from '../ui/format';
import { throttled } from './live';
import { sampleRows, stack } from './series';

describe('the cost chart', () => {
  const curves = {
    episode: [0, 1],
    cost_by_kind: { label_lo: [0, 6], inspect_full: [1, 2], label_hi: [0, 0] },
  } as unknown as Curves;

  it('stacks the kinds that cost something, in the order of the algorithm', () => {
    expect(stack(curves)).toEqual([
      { kind: 'inspect_full', own: [1, 2], upTo: [1, 2] },
      { kind: 'label_lo', own: [0, 6], upTo: [1, 8] },
    ]);
  });

  it('has a table short enough to read', () => {
    expect(sampleRows(3, 5)).toEqual([0, 1, 2]);
    expect(sampleRows(101, 5)).toEqual([0, 25, 50, 75, 100]);
    expect(sampleRows(0, 5)).toEqual([]);
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
