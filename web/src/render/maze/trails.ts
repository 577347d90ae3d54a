// Where the steps of a trajectory are drawn: side by side where a way is walked twice, like lanes of a street.
import { direction, type Cell } from './geometry';

/** A point on the map, in cells from its upper left corner. The middle of the first cell is (0.5, 0.5). */
export type Point = readonly [row: number, column: number];

/** A step as a line. */
export interface Lane {
  readonly from: Point;
  readonly to: Point;
  readonly way: Cell; // the direction of the step
}

const FIRST_LANE = 0.1; // cells to the right of the middle
const BETWEEN_LANES = 0.13;
const LAST_LANE = 0.36; // further out, it would leave its cell

/** Return the lane of the step from each frame to the next; null where the agent stays, and for the last frame. */
export function lanesOf(cells: readonly (Cell | null)[]): (Lane | null)[] {
  const walked = new Map<string, number>(); // how often each step was made
  const steps = cells.map((from, frame) => {
    const to = cells[frame + 1];
    const way = from && to ? direction(from, to) : null;
    if (!from || !to || !way) return null;
    const step = [...from, ...to].join();
    const before = walked.get(step) ?? 0;
    walked.set(step, before + 1);
    const aside = Math.min(FIRST_LANE + before * BETWEEN_LANES, LAST_LANE);
    const shift: Point = [way[1] * aside, -way[0] * aside]; // to the right, so that the way back is on the other side
    return { from, to, way, shift };
  });
  return steps.map((step, frame) => {
    if (step === null) return null;
    const { from, to, way, shift } = step;
    return {
      way,
      from: moved(from, shift, cornerOf(way, steps[frame - 1])),
      to: moved(to, shift, cornerOf(way, steps[frame + 1])),
    };
  });
}

/** Return how far a neighbor's lane is aside if the way turns between the two, so that they meet at the corner. */
function cornerOf(
  way: Cell,
  neighbor: { readonly way: Cell; readonly shift: Point } | null | undefined,
): Point {
  const turns = neighbor && way[0] * neighbor.way[0] + way[1] * neighbor.way[1] === 0;
  return turns ? neighbor.shift : [0, 0];
}

function moved([row, column]: Cell, ...shifts: Point[]): Point {
  return [
    shifts.reduce((sum, [down]) => sum + down, row + 0.5),
    shifts.reduce((sum, [, right]) => sum + right, column + 0.5),
  ];
}
