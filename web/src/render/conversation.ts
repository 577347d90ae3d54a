// Conversations: states whose view has a list of turns, or a text.
import { readable } from '../api/names';
import type { Json } from '../api/types';
import { t } from '../language/language';

/** One utterance. The speaker is null if the state does not say who spoke. */
export interface Turn {
  readonly speaker: string | null;
  readonly text: string;
}

/** A state that reads as a conversation. */
export interface Conversation {
  readonly turns: readonly Turn[];
  /** The other parts of the state, each with its name. */
  readonly rest: readonly (readonly [name: string, value: string])[];
}

/**
 * Return the conversation in a state's view; null if there is none.
 *
 * The view is an object with `turns`, a list of texts or of objects {speaker, text}, or with a `text`.
 */
export function conversationOf(view: Json): Conversation | null {
  if (!isObject(view)) return null;
  const { turns, text, ...others } = view;
  const said = turnsOf(turns);
  if (said !== null) {
    return { turns: said, rest: rows(text === undefined ? others : { text, ...others }) };
  }
  if (typeof text !== 'string') return null;
  return {
    turns: [{ speaker: null, text }],
    rest: rows(turns === undefined ? others : { turns, ...others }),
  };
}

/** Return how many turns of a state are new since the state before it. */
export function newTurns(now: Conversation, before: Conversation | null): number {
  if (before === null) return 0;
  const old = before.turns.findIndex((turn, index) => !sameTurn(turn, now.turns[index]));
  return now.turns.length - (old === -1 ? before.turns.length : old);
}

/** Return the first frame whose state has a turn; `turn` is its place in the conversation. */
export function frameOfTurn(frames: readonly Json[], turn: number): number {
  return frames.findIndex((view) => (conversationOf(view)?.turns.length ?? 0) > turn);
}

function turnsOf(value: Json): Turn[] | null {
  if (!Array.isArray(value)) return null;
  const turns = value.map(turnOf);
  return turns.some((turn) => turn === null) ? null : turns.filter((turn) => turn !== null);
}

function turnOf(value: Json): Turn | null {
  if (typeof value === 'string') return { speaker: null, text: value };
  if (!isObject(value) || typeof value.text !== 'string') return null;
  const speaker = value.speaker ?? null;
  return speaker === null || typeof speaker === 'string' ? { speaker, text: value.text } : null;
}

function rows(parts: Readonly<Record<string, Json>>): (readonly [string, string])[] {
  return Object.entries(parts).map(([name, value]) => [readable(name), words(value)] as const);
}

/** Return a value in words: "city Rome, day Friday" for an object, "—" for what is empty. */
function words(value: Json): string {
  if (value === null || value === '') return '—';
  if (typeof value === 'boolean') return value ? t('yes') : t('no');
  if (Array.isArray(value)) return value.map(words).join(', ') || '—';
  if (typeof value === 'string') return value;
  if (!isObject(value)) return JSON.stringify(value);
  return (
    Object.entries(value)
      .map(([name, part]) => `${readable(name)} ${words(part)}`)
      .join(', ') || '—'
  );
}

function sameTurn(a: Turn, b: Turn | undefined): boolean {
  return a.speaker === b?.speaker && a.text === b.text;
}

function isObject(value: unknown): value is Record<string, Json> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
