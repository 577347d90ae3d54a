// Where the tags of segments are: beside their cells, where they leave the agent free, and the labels if possible.
import type { Cell } from './geometry';
import { AGENT, around, type Rect } from './marks';
import type { Point } from './trails';

/** How far a tag is from the middle of its cell, along both axes or along one. Its outline leaves the agent free. */
const BESIDE = 0.29;
const BEYOND = 0.4;
const OUTLINE = 0.05; // of a tag, in cells

/** The directions from a cell where its tag can be, the best one first. */
const DIRECTIONS = [
  [-1, -1],
  [-1, 1],
  [1, -1],
  [1, 1],
  [-1, 0],
  [1, 0],
  [0, -1],
  [0, 1],
] as const;

/** What must be left free: the agent always, the rest as far as possible. */
export interface Taken {
  readonly agent: Cell | null;
  readonly others: readonly Rect[]; // labels, and places of subgoals
  readonly cells: number; // along a side of the maze
}

/**
 * Return the rectangle of each tag beside the middle of its cell, where the agent may come: where it covers least of what
 * is taken, and then of the tags before it. It never covers the agent. `size` is (height, width) in cells.
 */
export function placeTags(
  tags: readonly { readonly cell: Cell; readonly size: Point }[],
  { agent, others, cells }: Taken,
): Rect[] {
  const placed: Rect[] = [];
  for (const { cell, size } of tags) {
    // Each number counts only where those before it are equal.
    const costs = (rect: Rect): number[] => [
      Number(agent !== null && meets(rect, agent)),
      Number(meets(rect, cell)),
      covered(rect, others),
      covered(rect, placed),
    ];
    const choices = DIRECTIONS.map((direction) => {
      const rect = within(cells, beside(cell, direction, size));
      return { rect, costs: costs(rect) };
    });
    const [best] = choices.toSorted((a, b) => compared(a.costs, b.costs));
    if (best !== undefined) placed.push(best.rect);
  }
  return placed;
}

function compared(a: readonly number[], b: readonly number[]): number {
  return a.map((one, place) => one - (b[place] ?? 0)).find((difference) => difference !== 0) ?? 0;
}

/** Return whether a tag, with its outline, covers a part of the agent in a cell. */
export function meets({ top, left, bottom, right }: Rect, [row, column]: Cell): boolean {
  const outside = (at: number, low: number, high: number): number => Math.max(low - at, at - high, 0);
  const down = outside(row + 0.5, top - OUTLINE, bottom + OUTLINE);
  return Math.hypot(down, outside(column + 0.5, left - OUTLINE, right + OUTLINE)) < AGENT;
}

/** Return the area that a rectangle has in common with others, in cells; to a hundredth, so that equals stay equal. */
export function covered(rect: Rect, others: readonly Rect[]): number {
  const areas = others.map((other) => {
    const height = Math.min(rect.bottom, other.bottom) - Math.max(rect.top, other.top);
    const width = Math.min(rect.right, other.right) - Math.max(rect.left, other.left);
    return height > 0 && width > 0 ? height * width : 0;
  });
  return Math.round(100 * areas.reduce((sum, area) => sum + area, 0)) / 100;
}

function beside([row, column]: Cell, [down, right]: Point, [height, width]: Point): Rect {
  const distance = down === 0 || right === 0 ? BEYOND : BESIDE;
  const [rows, columns] = [distance + height / 2, distance + width / 2];
  return around([row + 0.5 + down * rows, column + 0.5 + right * columns], [height, width]);
}

/** Return a rectangle moved into the picture. */
function within(cells: number, { top, left, bottom, right }: Rect): Rect {
  const shift = (low: number, high: number): number => Math.max(-low, 0) - Math.max(high - cells, 0);
  const [down, aside] = [shift(top, bottom), shift(left, right)];
  return { top: top + down, left: left + aside, bottom: bottom + down, right: right + aside };
}
