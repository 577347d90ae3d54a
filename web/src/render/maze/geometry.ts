// The geometry of a maze: its cells, rooms, doors and lava.
import type { Json } from '../../api/types';
import { t } from '../../language/language';

export type Cell = readonly [row: number, column: number];

/** A maze: rooms between walls of lava, joined by doors. */
export interface Maze {
  readonly rows: readonly string[]; // '#' lava, '.' free
  readonly start: Cell;
  readonly goal: Cell;
}

/** The actions, as (row, column) of a step. */
export const MOVES: Readonly<Record<string, Cell>> = {
  up: [-1, 0],
  down: [1, 0],
  left: [0, -1],
  right: [0, 1],
};

/** The subgoals that lead to a neighboring room, as (row, column) of the way there. */
export const SIDES: Readonly<Record<string, Cell>> = {
  north: [-1, 0],
  south: [1, 0],
  west: [0, -1],
  east: [0, 1],
};
/** The subgoal of the room with the target. */
export const TARGET = 'go_to_target';

const ROOM_PITCH = 4; // cells: one of wall, three of room

export function parseMaze(json: Json): Maze | null {
  if (typeof json !== 'object' || json === null) return null;
  const { rows, start, goal } = json as Record<string, Json>;
  const from = parseCell(start);
  const to = parseCell(goal);
  if (!Array.isArray(rows) || rows.length === 0 || from === null || to === null) return null;
  if (!rows.every((row): row is string => typeof row === 'string')) return null;
  return { rows, start: from, goal: to };
}

export function parseCell(json: Json): Cell | null {
  if (!Array.isArray(json)) return null;
  const [row, column] = json as Json[];
  return typeof row === 'number' && typeof column === 'number' ? [row, column] : null;
}

export function isLava(maze: Maze, [row, column]: Cell): boolean {
  return maze.rows[row]?.[column] !== '.';
}

export function isWallLine([row, column]: Cell): boolean {
  return row % ROOM_PITCH === 0 || column % ROOM_PITCH === 0;
}

/** Return whether a cell is a door: a free cell in a wall, which belongs to no room. */
export function isDoor(maze: Maze, cell: Cell): boolean {
  return isWallLine(cell) && !isLava(maze, cell);
}

/** Return in words where a cell is. */
export function describeCell(maze: Maze, cell: Cell): string {
  if (sameCell(cell, maze.goal)) return t('on the target');
  if (isLava(maze, cell)) return t('in lava');
  if (isDoor(maze, cell)) return t(`in a door at row ${cell[0]}, column ${cell[1]}`);
  const [row, column] = [Math.ceil(cell[0] / ROOM_PITCH), Math.ceil(cell[1] / ROOM_PITCH)];
  return t(`in room ${row}–${column}`);
}

/** Return a name of the room of a cell; a cell of a wall line is a place of its own. */
export function placeName(cell: Cell): string {
  if (isWallLine(cell)) return cell.join();
  return `room:${cell.map((one) => Math.ceil(one / ROOM_PITCH)).join()}`;
}

/** Return the action that makes a step. */
export function actionOf(way: Cell): string | undefined {
  return Object.keys(MOVES).find((name) => sameCell(MOVES[name] ?? [0, 0], way));
}

/** Return the subgoal whose room lies in the direction of a step. */
export function sideOf(way: Cell): string | undefined {
  return Object.keys(SIDES).find((name) => sameCell(SIDES[name] ?? [0, 0], way));
}

export function sameCell(a: Cell, b: Cell): boolean {
  return a[0] === b[0] && a[1] === b[1];
}

/** Return the direction of a step as (row, column) of a unit vector; null if it stays in its cell. */
export function direction(from: Cell, to: Cell): Cell | null {
  const [rows, columns] = [to[0] - from[0], to[1] - from[1]];
  return rows === 0 && columns === 0 ? null : [Math.sign(rows), Math.sign(columns)];
}
