import { api, unwrap } from '../api/client';
import { ANSWERABLE, type Answer, type Assignment, type Me, type Receipt } from '../api/types';

/** What the work view asks of the server. */
export interface Desk {
  lease(wait: number, signal: AbortSignal): Promise<Assignment | null>;
  answer(letter: Pick<Letter, 'assignment' | 'token' | 'answer' | 'key'>, next: boolean): Promise<Receipt>;
  renew(held: Held): Promise<unknown>;
  release(held: Held, reason: string, skip: boolean): Promise<unknown>;
  retract(held: Held): Promise<Assignment>;
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

/** The server holds an answer's reply so long for the learner's next query. */
const NEXT_WAIT_SECONDS = 0.25;

export function restDesk(run: string | null): Desk {
  const wish = (wait: number) => ({ wait, kinds: [...ANSWERABLE], run, defer: 0 });
  const path = (held: Held) => ({ path: { assignment: held.assignment } });
  return {
    async lease(wait, signal) {
      const body = wish(wait);
      return (await unwrap(api.POST('/api/v1/assignments', { body, signal }))) ?? null;
    },
    answer(letter, next) {
      const { token, answer, key } = letter;
      const params = { ...path(letter), header: { 'Idempotency-Key': key } };
      const body = { token, answer, next: next ? wish(NEXT_WAIT_SECONDS) : null };
      return unwrap(api.POST('/api/v1/assignments/{assignment}/answer', { params, body }));
    },
    renew(held) {
      const body = { token: held.token };
      return unwrap(api.POST('/api/v1/assignments/{assignment}/renew', { params: path(held), body }));
    },
    release(held, reason, skip) {
      const body = { token: held.token, reason, skip };
      const options = { params: path(held), body, keepalive: true };
      return unwrap(api.POST('/api/v1/assignments/{assignment}/release', options));
    },
    retract(held) {
      const body = { token: held.token };
      return unwrap(api.POST('/api/v1/assignments/{assignment}/retract', { params: path(held), body }));
    },
    me: () => unwrap(api.GET('/api/v1/me')),
  };
}
