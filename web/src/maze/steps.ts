import type { Json } from '../api/types';
import { parseCell, type Cell } from './geometry';

const MOVES: Readonly<Record<string, Cell>> = { up: [-1, 0], down: [1, 0], left: [0, -1], right: [0, 1] };

/** The state that an action leads to; a maze has no chance in it. */
export function stepMaze(state: Json, action: string): Json {
  const cell = parseCell(state);
  const move = MOVES[action];
  if (cell === null || move === undefined) return state;
  return [cell[0] + move[0], cell[1] + move[1]];
}
