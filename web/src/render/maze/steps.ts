// The steps of the maze.
import type { Json } from '../../api/types';
import { MOVES, parseCell } from './geometry';

/** Return the state that an action leads to. Steps in a maze are deterministic. */
export function stepMaze(state: Json, action: string): Json {
  const cell = parseCell(state);
  const move = MOVES[action];
  if (cell === null || move === undefined) return state;
  return [cell[0] + move[0], cell[1] + move[1]];
}
