// The outbox: answers that the server has not acknowledged yet, oldest first. Pure, and kept in the tab's storage.
import type { Answer } from '../../api/types';

/** An answer on its way to the server. */
export interface PendingAnswer {
  readonly assignment: number;
  readonly token: string; // of the assignment
  readonly answer: Answer;
  readonly key: string; // the idempotency key: the server stores an answer once, however often it is sent
  readonly attempts: number;
}

export type Outbox = readonly PendingAnswer[];

const KEY = 'waypost:outbox';

export function add(outbox: Outbox, pending: PendingAnswer): Outbox {
  return [...without(outbox, pending.assignment), pending];
}

export function without(outbox: Outbox, assignment: number): Outbox {
  return outbox.filter((pending) => pending.assignment !== assignment);
}

/** Count one more attempt to send an answer. */
export function attempted(outbox: Outbox, assignment: number): Outbox {
  return outbox.map((pending) =>
    pending.assignment === assignment ? { ...pending, attempts: pending.attempts + 1 } : pending,
  );
}

/** Keep the outbox, so that it survives a reload. Return whether it is kept: the storage may be full or off. */
export function save(storage: Storage, outbox: Outbox): boolean {
  try {
    if (outbox.length === 0) storage.removeItem(KEY);
    else storage.setItem(KEY, JSON.stringify(outbox));
    return true;
  } catch {
    return outbox.length === 0;
  }
}

/** Return the outbox that was kept; an empty one if the storage contains anything else. */
export function load(storage: Storage): Outbox {
  try {
    const stored: unknown = JSON.parse(storage.getItem(KEY) ?? '[]');
    return Array.isArray(stored) ? stored.filter(isPendingAnswer) : [];
  } catch {
    return [];
  }
}

function isPendingAnswer(value: unknown): value is PendingAnswer {
  if (typeof value !== 'object' || value === null) return false;
  const pending = value as Partial<Record<keyof PendingAnswer, unknown>>;
  return (
    typeof pending.assignment === 'number' &&
    typeof pending.token === 'string' &&
    typeof pending.key === 'string' &&
    typeof pending.attempts === 'number' &&
    typeof pending.answer === 'object'
  );
}
