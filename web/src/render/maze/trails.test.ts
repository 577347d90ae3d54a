import { describe, expect, it } from 'vitest';
import type { Cell } from './geometry';
import { lanesOf, type Lane } from './trails';

const there: Cell[] = [
  [5, 1],
  [5, 2],
  [5, 3],
  [4, 3],
];
const walk = (...cells: Cell[]): Lane[] => lanesOf(cells).filter((lane) => lane !== null);

describe('the lanes of a trajectory', () => {
  it('join at every cell, straight on and around a corner to either side', () => {
    const lanes = walk(...there, [4, 4], [5, 4]);
    for (const [at, lane] of lanes.slice(1).entries()) {
      const before = lanes[at]?.to ?? [];
      expect(lane.from[0]).toBeCloseTo(before[0] ?? NaN);
      expect(lane.from[1]).toBeCloseTo(before[1] ?? NaN);
    }
  });

  it('do not hide the way there behind the way back', () => {
    const [to, , , back] = walk([5, 1], [5, 2], [5, 3], [5, 2], [5, 1]);
    expect(to?.from[0]).toBeGreaterThan(5.5); // on the right-hand side
    expect(back?.to[0]).toBeLessThan(5.5);
  });

  it('lie side by side when a way is walked again and again, within their cells', () => {
    const around: Cell[] = Array.from({ length: 8 }, (_, step) => [5, 1 + (step % 2)]);
    const rows = walk(...around)
      .filter(({ way }) => way[1] === 1)
      .map(({ from }) => from[0]);
    expect(new Set(rows.slice(0, 3)).size).toBe(3);
    expect(Math.max(...rows)).toBeLessThan(6);
  });

  it('have none for standing still, for unknown cells, and for the end', () => {
    expect(lanesOf([[1, 1], [1, 1], null, [2, 2]])).toEqual([null, null, null, null]);
  });
});
