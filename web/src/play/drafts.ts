// Drafts of demonstrations: the moves so far, kept in the storage of the tab.
import type { Vocabulary } from '../api/types';
import type { Move } from './demonstration';

const KEY = 'waypost:demonstrations';
const KEPT = 6;

type Drafts = readonly (readonly [query: unknown, moves: unknown])[]; // the newest last

/** The drafts. They survive a reload and an expired lease, until the tab is closed. */
export class PlayDrafts {
  readonly #storage: Storage;

  constructor(storage: Storage) {
    this.#storage = storage;
  }

  /** Return the moves of a query's draft; none if they do not fit the run's vocabulary. */
  of(query: string, vocabulary: Vocabulary): readonly Move[] {
    const moves = this.#load().find(([kept]) => kept === query)?.[1];
    return Array.isArray(moves) && moves.every((move) => fits(move, vocabulary)) ? moves : [];
  }

  keep(query: string, moves: readonly Move[]): void {
    const others = this.#load().filter(([kept]) => kept !== query);
    const drafts: Drafts = [...others, [query, moves] as const].slice(-KEPT);
    try {
      this.#storage.setItem(KEY, JSON.stringify(drafts));
    } catch {
      // The storage is full or off; the view itself still has the moves.
    }
  }

  #load(): Drafts {
    try {
      const stored: unknown = JSON.parse(this.#storage.getItem(KEY) ?? '[]');
      return Array.isArray(stored) ? stored.filter(isPair) : [];
    } catch {
      return [];
    }
  }
}

function isPair(entry: unknown): entry is [unknown, unknown] {
  return Array.isArray(entry) && entry.length === 2;
}

function fits(move: unknown, { subgoals, actions }: Vocabulary): move is Move {
  if (typeof move !== 'object' || move === null) return false;
  const { does, subgoal, action } = move as Partial<Record<'does' | 'subgoal' | 'action', string>>;
  if (does === 'choose') return subgoal !== undefined && subgoals.includes(subgoal);
  if (does === 'act') return action !== undefined && actions.includes(action);
  return does === 'reach' || does === 'restart';
}
