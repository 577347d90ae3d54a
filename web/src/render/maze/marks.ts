// Where the marks on a maze are: the agent, labels, and the end of the trajectory.
import type { Label, Scene } from '../../player/scene';
import { isLava, MOVES, parseCell, SIDES, type Cell, type Maze } from './geometry';
import type { Point } from './trails';

/** A rectangle in cells, from the upper left corner of the maze. */
export interface Rect {
  readonly top: number;
  readonly left: number;
  readonly bottom: number;
  readonly right: number;
}

export const AGENT = 0.33; // of a cell: how far the agent reaches from the middle, with its edge
const ARROW = { length: 0.38, width: 0.44 } as const; // of a cell
/** How far the middle of an arrow is from that of its cell: ahead, and to the right, where the lanes of the path are. */
const AHEAD = 0.3;
const ASIDE = 0.27;
/** How far the other labels reach. The agent, which is drawn on top of them, does not hide them. */
const BLOCK = { square: 0.34, diamond: 0.46 } as const;

/** Return the direction of a label's arrow; null for a label without an arrow. */
export function wayOf({ name }: Label): Cell | null {
  return name === null ? null : (MOVES[name] ?? SIDES[name] ?? null);
}

/**
 * Return the rectangle that a label covers. An arrow keeps to the right within its cell, like a car on its lane: so it
 * touches no other arrow, neither out of its cell nor into it.
 */
export function labelRect([row, column]: Cell, label: Label): Rect {
  const way = wayOf(label);
  const middle: Point = [row + 0.5, column + 0.5];
  if (way === null) {
    const reach = label.name === null ? BLOCK.square : BLOCK.diamond;
    return around(middle, [2 * reach, 2 * reach]);
  }
  const [down, right] = way;
  const at: Point = [middle[0] + down * AHEAD + right * ASIDE, middle[1] + right * AHEAD - down * ASIDE];
  return around(at, down === 0 ? [ARROW.width, ARROW.length] : [ARROW.length, ARROW.width]);
}

/**
 * Return how the end of the trajectory is marked: in lava with a cross, elsewhere with a ring; null where the agent, or the
 * label “done here”, is in the place of the ring.
 */
export function endMark({ tape, at, labels }: Scene, maze: Maze): 'cross' | 'ring' | null {
  const last = tape.frames.length - 1;
  const cell = parseCell(tape.frames[last]);
  if (cell === null) return null;
  if (isLava(maze, cell)) return 'cross';
  return at === last || labels.some(({ frame, name }) => frame === last && name === null) ? null : 'ring';
}

export function around([row, column]: Point, [height, width]: Point): Rect {
  return {
    top: row - height / 2,
    left: column - width / 2,
    bottom: row + height / 2,
    right: column + width / 2,
  };
}
