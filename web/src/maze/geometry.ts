import type { Json } from '../api/types';

export type Cell = readonly [row: number, column: number];

/** A maze: rooms between walls of lava, joined by doors. */
export interface Maze {
  readonly rows: readonly string[]; // '#' lava, '.' free
  readonly start: Cell;
  readonly goal: Cell;
}

const ROOM_PITCH = 4; // a wall and a room of three cells

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

/** A free cell in a wall belongs to no room. */
export function isDoor(maze: Maze, cell: Cell): boolean {
  return isWallLine(cell) && !isLava(maze, cell);
}

/** Where a cell is, in words. */
export function describeCell(maze: Maze, cell: Cell): string {
  if (sameCell(cell, maze.goal)) return 'on the target';
  if (isLava(maze, cell)) return 'in lava';
  if (isDoor(maze, cell)) return `in a door at row ${cell[0]}, column ${cell[1]}`;
  const [row, column] = [Math.ceil(cell[0] / ROOM_PITCH), Math.ceil(cell[1] / ROOM_PITCH)];
  return `in room ${row}–${column}`;
}

export function sameCell(a: Cell, b: Cell): boolean {
  return a[0] === b[0] && a[1] === b[1];
}

/** Which way a step goes, as (row, column) of a unit vector; null when it stays. */
export function direction(from: Cell, to: Cell): Cell | null {
  const [rows, columns] = [to[0] - from[0], to[1] - from[1]];
  return rows === 0 && columns === 0 ? null : [Math.sign(rows), Math.sign(columns)];
}

const OFFSETS = [0, 0.13, -0.13];

/** How far, in cells, a segment's trail is shifted, so that a way there and back does not lie on itself. */
export function trailOffset(index: number): number {
  return OFFSETS[index % OFFSETS.length] ?? 0;
}
