import { describe, expect, it } from 'vitest';
import { covered, labelRect, placeMarkers, type Rect } from './marks';

// (height, width) in cells: where cells are 40 pixels wide, and on a phone, where they are 21
const SIZES = [
  [0.49, 0.56],
  [0.67, 0.86],
] as const;

function marker(
  size: readonly [number, number],
  ...labels: (string | null)[]
): { rect: Rect; labels: Rect[] } {
  const rects = labels.map((name) => labelRect([5, 5], { frame: 0, name }));
  const [rect] = placeMarkers([{ cell: [5, 5], size }], rects);
  if (rect === undefined) throw new Error('no marker');
  return { rect, labels: rects };
}

describe.each(SIZES)('a marker of %f x %f cells', (...size) => {
  it.each(['up', 'down', 'left', 'right', 'north', 'east'])(
    'leaves the arrow “%s” of its state free',
    (name) => {
      const { rect, labels } = marker(size, name);
      expect(covered(rect, labels)).toBeLessThan(0.02);
    },
  );

  it('is at the upper left corner where nothing is in its way', () => {
    const { rect } = marker(size);
    expect([(rect.top + rect.bottom) / 2, (rect.left + rect.right) / 2]).toEqual([5.14, 5.14]);
    expect(marker(size, 'right').rect).toEqual(rect);
  });

  it('leaves the label of a neighboring state free', () => {
    const labels = [
      labelRect([4, 5], { frame: 0, name: 'down' }),
      labelRect([5, 4], { frame: 1, name: 'right' }),
    ];
    const [rect] = placeMarkers([{ cell: [5, 5], size }], labels);
    expect(rect && covered(rect, labels)).toBeLessThan(0.02);
  });

  it('leaves a marker before it free, in the same cell too', () => {
    const [first, second] = placeMarkers(
      [5, 5].map((at) => ({ cell: [at, at] as const, size })),
      [],
    );
    expect(first && second && covered(first, [second])).toBeLessThan(0.11);
    expect(first).not.toEqual(second);
  });
});

describe('what is covered', () => {
  const rect = { top: 0, left: 0, bottom: 1, right: 1 };

  it('is the common area', () => {
    expect(covered(rect, [{ top: 0.5, left: 0.5, bottom: 2, right: 2 }, rect])).toBe(1.25);
    expect(covered(rect, [{ top: 1, left: 0, bottom: 2, right: 1 }])).toBe(0);
    expect(covered(rect, [])).toBe(0);
  });

  it('is known for a label in the middle of its cell', () => {
    expect(labelRect([0, 0], { frame: 0, name: null })).toEqual(
      labelRect([0, 0], { frame: 0, name: 'go_to_target' }),
    );
  });
});
