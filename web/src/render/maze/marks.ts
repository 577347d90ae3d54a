// Where the marks on a maze are: labels, and the markers of segments, which leave the labels free.
import type { Label } from '../../player/scene';
import { MOVES, SIDES, type Cell } from './geometry';
import type { Point } from './trails';

/** A rectangle in cells, from the upper left corner of the maze. */
export interface Rect {
  readonly top: number;
  readonly left: number;
  readonly bottom: number;
  readonly right: number;
}

export const ARROW = 0.3; // of a cell: how far the arrow of a label reaches from its middle
export const OUTWARD = 0.34; // of a cell: how far the middle of the arrow is from that of its cell
export const BLOCK = 0.22; // of a cell: how far the other labels reach

/** The corners of a cell where a marker can be, the best one first. */
const CORNERS = [
  [-0.36, -0.36],
  [-0.36, 0.36],
  [0.36, -0.36],
  [0.36, 0.36],
] as const;

/** Return the direction of a label's arrow; null for a label without an arrow. */
export function wayOf({ name }: Label): Cell | null {
  return name === null ? null : (MOVES[name] ?? SIDES[name] ?? null);
}

/** Return the rectangle that a label covers. */
export function labelRect(cell: Cell, label: Label): Rect {
  const [down, right] = wayOf(label) ?? [0, 0];
  const reach = wayOf(label) === null ? BLOCK : ARROW;
  const middle: Point = [cell[0] + 0.5 + down * OUTWARD, cell[1] + 0.5 + right * OUTWARD];
  return around(middle, [2 * reach, 2 * reach]);
}

/**
 * Return the rectangle of each marker at a corner of its cell: where it covers least of the labels, and then of the
 * markers before it. `size` is (height, width) in cells.
 */
export function placeMarkers(
  markers: readonly { readonly cell: Cell; readonly size: Point }[],
  labels: readonly Rect[],
): Rect[] {
  const placed: Rect[] = [];
  for (const { cell, size } of markers) {
    const choices = CORNERS.map(([down, right]) =>
      around([cell[0] + 0.5 + down, cell[1] + 0.5 + right], size),
    );
    const [best] = choices.toSorted(
      (a, b) => covered(a, labels) - covered(b, labels) || covered(a, placed) - covered(b, placed),
    );
    if (best !== undefined) placed.push(best);
  }
  return placed;
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

function around([row, column]: Point, [height, width]: Point): Rect {
  return {
    top: row - height / 2,
    left: column - width / 2,
    bottom: row + height / 2,
    right: column + width / 2,
  };
}
