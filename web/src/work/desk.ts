import { api, unwrap } from '../api/client';
import { KINDS, type Answer, type Assignment, type Lease, type Me, type Receipt } from '../api/types';

/** What the work view asks of the server, besides taking answers. */
export interface Desk {
  lease(wish: Lease, signal: AbortSignal): Promise<Assignment | null>;
  renew(held: Held, active: boolean): Promise<unknown>;
  release(held: Held, reason: string, skip: boolean): Promise<unknown>;
  /** The page is going: all that was or is being leased to it goes back, but what is kept to be answered. */
  leave(tab: string, keep: number[]): Promise<unknown>;
  retract(held: Held, tab: string): Promise<Assignment>;
  me(): Promise<Me>;
}

/** Shows that a lease is ours. */
export interface Held {
  readonly assignment: number;
  readonly token: string;
}

/** An answer on its way. */
export interface Letter extends Held {
  readonly answer: Answer;
  readonly key: string; // sending it twice stores it once
  readonly attempts: number;
}

/** Stores an answer; with `next`, the receipt brings the next query. */
export type SendAnswer = (letter: Letter, next: Lease | null) => Promise<Receipt>;

export function wish(run: string | null, tab: string, wait: number, ahead = false): Lease {
  return { wait, kinds: [...KINDS], run, defer: 0, ahead, tab };
}

export function heldOf(assignment: Assignment): Held {
  return { assignment: assignment.id, token: assignment.token };
}

const path = (held: Held) => ({ path: { assignment: held.assignment } });

export const restDesk: Desk = {
  async lease(body, signal) {
    return (await unwrap(api.POST('/api/v1/assignments', { body, signal }))) ?? null;
  },
  renew(held, active) {
    const body = { token: held.token, active };
    return unwrap(api.POST('/api/v1/assignments/{assignment}/renew', { params: path(held), body }));
  },
  release(held, reason, skip) {
    const body = { token: held.token, reason, skip };
    const options = { params: path(held), body, keepalive: true }; // also while the page closes
    return unwrap(api.POST('/api/v1/assignments/{assignment}/release', options));
  },
  leave(tab, keep) {
    return unwrap(api.POST('/api/v1/assignments/leave', { body: { tab, keep }, keepalive: true }));
  },
  retract(held, tab) {
    const body = { token: held.token, tab };
    return unwrap(api.POST('/api/v1/assignments/{assignment}/retract', { params: path(held), body }));
  },
  me: () => unwrap(api.GET('/api/v1/me')),
};

export const sendAnswer: SendAnswer = (letter, next) => {
  const { token, answer, key } = letter;
  const params = { ...path(letter), header: { 'Idempotency-Key': key } };
  return unwrap(
    api.POST('/api/v1/assignments/{assignment}/answer', { params, body: { token, answer, next } }),
  );
};
