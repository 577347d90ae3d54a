import type { Letter } from './desk';

/** Answers that the server has not acknowledged yet, oldest first. Pure. */
export type Outbox = readonly Letter[];

const KEY = 'waypost:outbox';
const FIRST_DELAY_MS = 500;
const LONGEST_DELAY_MS = 8_000;

export function add(outbox: Outbox, letter: Letter): Outbox {
  return [...without(outbox, letter.assignment), letter];
}

export function without(outbox: Outbox, assignment: number): Outbox {
  return outbox.filter((letter) => letter.assignment !== assignment);
}

export function attempted(outbox: Outbox, assignment: number): Outbox {
  return outbox.map((letter) =>
    letter.assignment === assignment ? { ...letter, attempts: letter.attempts + 1 } : letter,
  );
}

/** How long to wait before trying again. */
export function delay(attempts: number): number {
  return Math.min(FIRST_DELAY_MS * 2 ** Math.max(0, attempts - 1), LONGEST_DELAY_MS);
}

/** An answer outlives a reload of the page. */
export function save(storage: Storage, outbox: Outbox): void {
  if (outbox.length === 0) storage.removeItem(KEY);
  else storage.setItem(KEY, JSON.stringify(outbox));
}

export function load(storage: Storage): Outbox {
  try {
    const stored: unknown = JSON.parse(storage.getItem(KEY) ?? '[]');
    return Array.isArray(stored) ? stored.filter(isLetter) : [];
  } catch {
    return [];
  }
}

function isLetter(value: unknown): value is Letter {
  if (typeof value !== 'object' || value === null) return false;
  const letter = value as Partial<Record<keyof Letter, unknown>>;
  return (
    typeof letter.assignment === 'number' &&
    typeof letter.token === 'string' &&
    typeof letter.key === 'string' &&
    typeof letter.attempts === 'number' &&
    typeof letter.answer === 'object'
  );
}
