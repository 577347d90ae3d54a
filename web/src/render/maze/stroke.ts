// A way that an annotator draws on the maze, cell by cell, and the labels that it means.
import type { Choice } from '../../player/scene';
import { askedFrames, type Tape } from '../../player/tape';
import {
  actionOf,
  isLava,
  parseCell,
  placeName,
  sameCell,
  sideOf,
  TARGET,
  type Cell,
  type Maze,
} from './geometry';

/** The cells from the first to the one under the pointer; each is beside the one before it. */
export type Stroke = readonly Cell[];

/**
 * Return the stroke with the way to another cell. It never enters lava: where the pointer crosses lava, the stroke waits
 * until a free way leads on. Going back over its last cell takes this cell away.
 */
export function extended(maze: Maze, stroke: Stroke, cell: Cell): Stroke {
  const tip = stroke.at(-1);
  if (tip === undefined) return isLava(maze, cell) ? stroke : [cell];
  return wayTo(maze, tip, cell).reduce(grown, stroke);
}

/** Return the actions that lead straight, or around one corner, to a cell; none if lava is in the way. */
export function actionsTo(maze: Maze, from: Cell, to: Cell): string[] {
  const cells = [from, ...wayTo(maze, from, to)];
  return cells.slice(1).flatMap((_, at) => actionOf(wayOn(cells, at)) ?? []);
}

function wayTo(maze: Maze, from: Cell, to: Cell): Cell[] {
  const ways = [walk(from, to, 0), walk(from, to, 1)];
  return ways.find((way) => !way.some((one) => isLava(maze, one))) ?? [];
}

function grown(stroke: Stroke, cell: Cell): Stroke {
  const before = stroke.at(-2);
  return before && sameCell(before, cell) ? stroke.slice(0, -1) : [...stroke, cell];
}

/** Return the cells after `from` on the way to `to`: first along one axis (0: rows), then along the other. */
function walk(from: Cell, to: Cell, first: 0 | 1): Cell[] {
  const corner: Cell = first === 0 ? [to[0], from[1]] : [from[0], to[1]];
  return [...line(from, corner), ...line(corner, to)];
}

function line([row, column]: Cell, to: Cell): Cell[] {
  const [rows, columns] = [to[0] - row, to[1] - column];
  const length = Math.abs(rows) + Math.abs(columns);
  return Array.from({ length }, (_, step): Cell => {
    const share = (step + 1) / length;
    return [row + rows * share, column + columns * share];
  });
}

/** Return the action of each asked state that the stroke leaves: a right action depends on the state alone. */
export function actionsAlong(stroke: Stroke, tape: Tape): Choice[] {
  return askedFrames(tape)
    .slice(0, -1)
    .flatMap((frame) => {
      const cell = parseCell(tape.frames[frame]);
      const at = cell === null ? -1 : stroke.slice(0, -1).findLastIndex((one) => sameCell(one, cell));
      const name = at === -1 ? undefined : actionOf(wayOn(stroke, at));
      return name === undefined ? [] : [{ frame, name }];
    });
}

/**
 * Return the subgoal of each asked segment that begins in a room of the stroke: the side where the stroke leaves this
 * room, or the target if the stroke reaches it there.
 */
export function subgoalsAlong(stroke: Stroke, tape: Tape, maze: Maze): Choice[] {
  const reached = stroke.some((cell) => sameCell(cell, maze.goal)) ? placeName(maze.goal) : null;
  return tape.stretches.flatMap(({ asked, first }) => {
    const start = parseCell(tape.frames[first]);
    if (!asked || start === null) return [];
    const room = placeName(start);
    if (room === reached) return [{ frame: first, name: TARGET }];
    const at = stroke.slice(0, -1).findLastIndex((cell) => placeName(cell) === room);
    const leaves = at !== -1 && placeName(stroke[at + 1] ?? start) !== room;
    const name = leaves ? sideOf(wayOn(stroke, at)) : undefined;
    return name === undefined ? [] : [{ frame: first, name }];
  });
}

/** Return the frame of the asked state where the stroke ends: the next one after the labeled states, else null. */
export function endOf(stroke: Stroke, tape: Tape, choices: readonly Choice[]): number | null {
  const tip = stroke.at(-1);
  const labeled = Math.max(-1, ...choices.map(({ frame }) => frame));
  const isEnd = (frame: number): boolean => {
    const cell = parseCell(tape.frames[frame]);
    return frame > labeled && tip !== undefined && cell !== null && sameCell(cell, tip);
  };
  return askedFrames(tape).find(isEnd) ?? null;
}

function wayOn(stroke: Stroke, at: number): Cell {
  const [from = [0, 0], to = [0, 0]] = stroke.slice(at, at + 2);
  return [to[0] - from[0], to[1] - from[1]];
}
