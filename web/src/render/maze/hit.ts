// What lies under the pointer on a maze. A point is in cells from the upper left corner.
import {
  isDoor,
  isLava,
  parseCell,
  placeName,
  sameCell,
  SIDES,
  TARGET,
  type Cell,
  type Maze,
} from './geometry';
import type { Tape } from '../../player/tape';
import type { Point } from './trails';

/** A place on the map that stands for a subgoal: a door of the room for the side where it is, the target for itself. */
export interface Place {
  readonly subgoal: string;
  readonly cell: Cell;
}

/** WCAG 2.2 asks for targets of 24 CSS pixels. Cells are smaller on a phone, so a point may lie beside its target. */
const LEAST_TARGET = 24;

/** Return how far from its middle, in cells, a target can be hit, if a cell is `unit` CSS pixels wide. */
export function reachOf(unit: number): number {
  return Math.max(0.5, LEAST_TARGET / 2 / unit);
}

export function cellAt([row, column]: Point): Cell {
  return [Math.floor(row), Math.floor(column)];
}

/** Return the places of the subgoals that can be chosen at a cell. */
export function placesOf(maze: Maze, from: Cell, subgoals: readonly string[]): Place[] {
  return subgoals.flatMap((subgoal) => {
    if (subgoal === TARGET) return [{ subgoal, cell: maze.goal }];
    const side = SIDES[subgoal];
    return side === undefined ? [] : waysOut(maze, from, side).map((cell) => ({ subgoal, cell }));
  });
}

/** Return the doors on a side of the room of a cell; for a cell in a door, the cell behind it on this side. */
function waysOut(maze: Maze, from: Cell, [down, right]: Cell): Cell[] {
  if (isDoor(maze, from)) {
    const behind: Cell = [from[0] + down, from[1] + right];
    return isLava(maze, behind) ? [] : [behind];
  }
  const all = maze.rows.flatMap((cells, row) => Array.from(cells, (_, column): Cell => [row, column]));
  const room = placeName(from);
  return all.filter(
    ([row, column]) => isDoor(maze, [row, column]) && placeName([row - down, column - right]) === room,
  );
}

/** Return the place at a point; null if there is none. */
export function placeAt(places: readonly Place[], point: Point, reach: number): Place | null {
  return nearest(places, (place) => place.cell, point, reach);
}

/**
 * Return the frame whose state is at a point; null if the trajectory does not pass there. Where it passes more than once,
 * each click leads to the next time.
 */
export function frameAt(tape: Tape, at: number, point: Point, reach: number): number | null {
  const cells = tape.frames.map(parseCell).filter((cell) => cell !== null);
  const hit = nearest(cells, (cell) => cell, point, reach);
  if (hit === null) return null;
  const isHere = (view: unknown): boolean => {
    const cell = parseCell(view);
    return cell !== null && sameCell(cell, hit);
  };
  const next = tape.frames.findIndex((view, frame) => frame > at && isHere(view));
  return next === -1 ? tape.frames.findIndex(isHere) : next;
}

/** Return the free cell beside the agent's at a point; null if there is none. */
export function cellBeside(maze: Maze, [row, column]: Cell, point: Point, reach: number): Cell | null {
  const around: Cell[] = Object.values(SIDES).map(([down, right]) => [row + down, column + right]);
  return nearest(
    around.filter((cell) => !isLava(maze, cell)),
    (cell) => cell,
    point,
    reach,
  );
}

/** Return whether a point is on the agent's cell, or within reach of it. */
export function isOn(cell: Cell, point: Point, reach: number): boolean {
  return nearest([cell], (one) => one, point, reach) !== null;
}

/** Return the target in the cell of a point, else the nearest target within reach, else null. */
function nearest<T>(
  targets: readonly T[],
  cellOf: (target: T) => Cell,
  point: Point,
  reach: number,
): T | null {
  const distance = (target: T): number => {
    const [row, column] = cellOf(target);
    return Math.max(Math.abs(row + 0.5 - point[0]), Math.abs(column + 0.5 - point[1]));
  };
  const [first] = targets.toSorted((a, b) => distance(a) - distance(b));
  return first !== undefined && distance(first) <= reach ? first : null;
}
