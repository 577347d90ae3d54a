import { describe, expect, it } from 'vitest';
import type { Curves } from '../../api/types';
import { joined, stackOf, successOf, xAxisOf } from './curves';

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
    reward: [],
    reached: {},
    ...more,
  };
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

  it('join attempts at subgoals that only the later part has', () => {
    const begun = curvesWith({ episode: [0, 1], reached: { stair: [0, 0.01] } });
    const more = curvesWith({ episode: [2], reached: { stair: [0.02], key: [0.01] } });
    expect(joined(begun, more).reached).toEqual({ stair: [0, 0.01, 0.02], key: [0, 0, 0.01] });
  });

  it('know only their own axes', () => {
    expect([xAxisOf('seconds'), xAxisOf('__proto__'), xAxisOf(null)]).toEqual([
      'seconds',
      'episode',
      'episode',
    ]);
  });
});
