import { describe, expect, it } from 'vitest';
import type { Cell } from './geometry';
import { AGENT, labelRect, type Rect } from './marks';
import { covered, meets, placeTags } from './tags';

// (height, width) in cells: where cells are 40 pixels wide, on a phone, and of a long tag on a low phone
const SIZES = [
  [0.49, 0.56],
  [0.93, 1.35],
  [1.08, 2.6],
] as const;
const NAMES = ['up', 'down', 'left', 'right', 'north', 'east'];
const CELLS = 17;
const INNER = Array.from({ length: (CELLS - 2) ** 2 }, (_, index): Cell => [
  1 + Math.floor(index / (CELLS - 2)),
  1 + (index % (CELLS - 2)),
]);

function tag(size: readonly [number, number], ...labels: (string | null)[]): { rect: Rect; labels: Rect[] } {
  const others = labels.map((name) => labelRect([5, 5], { frame: 0, name }));
  const [rect] = placeTags([{ cell: [5, 5], size }], { agent: null, others, cells: CELLS });
  if (rect === undefined) throw new Error('no tag');
  return { rect, labels: others };
}

describe.each(SIZES)('a tag of %f x %f cells', (...size) => {
  it('never covers the agent, in its own cell and in those around it, at the edge too', () => {
    const around = [-2, -1, 0, 1, 2];
    for (const cell of INNER) {
      for (const agent of around.flatMap((down) =>
        around.map((right): Cell => [cell[0] + down, cell[1] + right]),
      )) {
        const [rect] = placeTags([{ cell, size }], { agent, others: [], cells: CELLS });
        expect(rect && meets(rect, agent), `${cell.join()} ${agent.join()}`).toBe(false);
      }
    }
  });

  it('never leaves the picture', () => {
    for (const cell of INNER) {
      const [rect] = placeTags([{ cell, size }], { agent: cell, others: [], cells: CELLS });
      expect(Math.min(rect?.top ?? -1, rect?.left ?? -1)).toBeGreaterThanOrEqual(0);
      expect(Math.max(rect?.bottom ?? CELLS + 1, rect?.right ?? CELLS + 1)).toBeLessThanOrEqual(CELLS);
    }
  });

  it.each([...NAMES, null])('leaves the label “%s” of its state free', (name) => {
    const { rect, labels } = tag(size, name);
    expect(covered(rect, labels)).toBeLessThan(0.02);
  });

  it('stays at the upper left where nothing is in its way, with the agent in its cell or not', () => {
    const { rect } = tag(size);
    expect([rect.bottom, rect.right].map((edge) => Math.round(edge * 100))).toEqual([521, 521]);
    expect(tag(size, 'right').rect).toEqual(rect);
    expect(placeTags([{ cell: [5, 5], size }], { agent: [5, 5], others: [], cells: CELLS })).toEqual([rect]);
  });

  it('leaves the label of a neighboring state free', () => {
    const others = [
      labelRect([4, 5], { frame: 0, name: 'down' }),
      labelRect([5, 4], { frame: 1, name: 'right' }),
    ];
    const [rect] = placeTags([{ cell: [5, 5], size }], { agent: null, others, cells: CELLS });
    expect(rect && covered(rect, others)).toBeLessThan(0.02);
  });

  it('leaves a tag before it free, in the same cell too', () => {
    const both = [5, 5].map((at) => ({ cell: [at, at] as const, size }));
    const [first, second] = placeTags(both, { agent: null, others: [], cells: CELLS });
    expect(first && second && covered(first, [second])).toBe(0);
  });
});

describe('arrows of labels', () => {
  const apart = (cell: Cell, name: string, other: Cell, another: string): void => {
    const [one, two] = [labelRect(cell, { frame: 0, name }), labelRect(other, { frame: 0, name: another })];
    expect(covered(one, [two]), `${name} at ${cell.join()}, ${another} at ${other.join()}`).toBe(0);
  };

  it.each(['up', 'down', 'left', 'right'])(
    '“%s” touches no other, in its cell and in those around it',
    (name) => {
      for (const another of ['up', 'down', 'left', 'right']) {
        if (another !== name) apart([5, 5], name, [5, 5], another);
        for (const other of [
          [4, 5],
          [6, 5],
          [5, 4],
          [5, 6],
          [4, 4],
          [6, 6],
        ] as const) {
          apart([5, 5], name, other, another);
        }
      }
    },
  );

  it.each([...NAMES, 'go_to_target', null])(
    '“%s” is seen beside the agent, which is drawn over it',
    (name) => {
      const { top, left, bottom, right } = labelRect([0, 0], { frame: 0, name });
      const reach = Math.max(...[top, left, bottom, right].map((edge) => Math.abs(edge - 0.5)));
      expect(reach).toBeGreaterThan(AGENT);
    },
  );
});

describe('what is covered', () => {
  const rect = { top: 0, left: 0, bottom: 1, right: 1 };

  it('is the common area', () => {
    expect(covered(rect, [{ top: 0.5, left: 0.5, bottom: 2, right: 2 }, rect])).toBe(1.25);
    expect(covered(rect, [{ top: 1, left: 0, bottom: 2, right: 1 }])).toBe(0);
    expect(covered(rect, [])).toBe(0);
  });
});
