// The commands of the player.
import type { Command } from '../keys/registry';
import { changeSpeed, jump, seek, step, toggle, type Player } from './player';

type Move = (player: Player, stops: readonly number[]) => Player;

/** The moves of the player, by command. */
export const MOVES: Partial<Record<Command, Move>> = {
  play: toggle,
  back: (player) => step(player, -1),
  forward: (player) => step(player, 1),
  'back-5': (player) => step(player, -5),
  'forward-5': (player) => step(player, 5),
  start: (player) => seek(player, player.first),
  end: (player) => seek(player, player.last),
  'previous-stop': (player, stops) => jump(player, stops, -1),
  'next-stop': (player, stops) => jump(player, stops, 1),
  slower: (player) => changeSpeed(player, -1),
  faster: (player) => changeSpeed(player, 1),
};
