import { isAborted, Refused, Unreachable, wordsOf } from '../api/client';
import type { Answer, Assignment, Me } from '../api/types';
import { wish, type Desk, type Held, type Letter } from './desk';
import { beat, pause, visible } from './heartbeat';
import type { Mailer } from './mailer';
import { delay } from './outbox';

export type Phase = 'loading' | 'waiting' | 'task' | 'sending' | 'offline' | 'signed-out' | 'refused';

export interface Notice {
  readonly tone: 'info' | 'warning';
  readonly text: string;
}

const POLL_SECONDS = 20;
/** The server holds a receipt back so long for the learner's next query. */
const NEXT_SECONDS = 0.25;
const UNDO_DEPTH = 10;
const ME_EVERY_MS = 5_000;

/** One annotator at work: leases a query, keeps the lease, sends the answer, goes on to the next. */
export class WorkSession {
  phase: Phase = $state('loading');
  assignment: Assignment | null = $state.raw(null);
  shown = $state(0); // how many queries have been put on the screen
  notice: Notice | null = $state.raw(null);
  me: Me | null = $state.raw(null);

  readonly #desk: Desk;
  readonly #mailer: Mailer;
  readonly #run: string | null; // only this run's queries
  readonly #stopListening: () => void;
  #lookup = new AbortController();
  #stopBeating = (): void => undefined;
  #sending: Promise<unknown> = Promise.resolve();
  #sent: readonly Held[] = []; // what can be undone, oldest first
  #stopped = false;
  #meAt = 0;

  constructor(desk: Desk, mailer: Mailer, run: string | null) {
    this.#desk = desk;
    this.#mailer = mailer;
    this.#run = run;
    this.#stopListening = mailer.listen({
      stored: () => this.#count(),
      refused: (reason) => this.#warn(refusalWords(reason)),
    });
  }

  start(): void {
    void this.#refreshMe();
    void this.#lookForWork();
  }

  /** Give back what is on the screen and stop asking. What is unsaved goes on being sent. */
  stop(): void {
    this.#stopped = true;
    this.#stopListening();
    this.#setAside();
  }

  /** The page is going, perhaps for good: give the query back. */
  leave(): void {
    this.#setAside();
    if (this.phase === 'task') this.phase = 'loading';
  }

  /** The page is back, out of the browser's memory of it. */
  resume(): void {
    if (this.assignment === null) void this.#lookForWork();
  }

  submit(answer: Answer): void {
    const held = this.#held();
    if (held === null || this.phase !== 'task') return;
    this.#stopBeating();
    this.notice = null;
    this.phase = 'sending';
    this.#sending = this.#send({ ...held, answer, key: newKey(held.assignment), attempts: 0 });
  }

  async skip(reason: string): Promise<void> {
    const held = this.#held();
    if (held === null || this.phase !== 'task') return;
    this.phase = 'sending';
    try {
      await this.#desk.release(held, reason, true);
      this.notice = { tone: 'info', text: 'Skipped. It will not be offered to you again.' };
    } catch (error) {
      if (error instanceof Unreachable) {
        this.phase = 'task';
        this.#warn('The server cannot be reached, so the query is not skipped yet. Try again in a moment.');
        return;
      }
    }
    this.#forget();
    void this.#lookForWork();
  }

  async undo(): Promise<void> {
    await this.#sending;
    const last = this.#sent.at(-1);
    if (last === undefined) {
      this.notice = { tone: 'info', text: 'There is no answer to take back yet.' };
      return;
    }
    try {
      const assignment = await this.#desk.retract(last);
      this.#sent = this.#sent.slice(0, -1);
      this.#setAside();
      this.#show(assignment);
      this.notice = { tone: 'info', text: 'Taken back. Answer it again.' };
    } catch (error) {
      this.#warn(wordsOf(error), error instanceof Refused ? UNDO_REFUSED[error.name] : undefined);
    }
  }

  async #send(letter: Letter): Promise<void> {
    const receipt = await this.#mailer.send(letter, wish(this.#run, NEXT_SECONDS));
    if (receipt !== null) this.#sent = [...this.#sent, letter].slice(-UNDO_DEPTH);
    this.#forget();
    const next = receipt?.next ?? null;
    if (next === null) void this.#lookForWork();
    else if (this.#stopped) void this.#giveBack({ assignment: next.id, token: next.token });
    else this.#show(next);
  }

  async #lookForWork(): Promise<void> {
    this.#lookup.abort();
    const { signal } = (this.#lookup = new AbortController());
    let [attempts, wait] = [0, 0];
    while (!signal.aborted && !this.#stopped) {
      try {
        await visible(signal);
        const found =
          (await this.#mailer.flush(wish(this.#run, 0))) ??
          (await this.#desk.lease(wish(this.#run, wait), signal));
        if (found !== null) return this.#show(found);
        [attempts, wait] = [0, POLL_SECONDS];
        this.phase = 'waiting';
      } catch (error) {
        if (isAborted(error)) return;
        if (error instanceof Refused) return this.#turnAway(error);
        this.phase = 'offline';
        await pause(delay(++attempts), signal);
      }
    }
  }

  #show(assignment: Assignment): void {
    this.assignment = assignment;
    this.phase = 'task';
    this.shown += 1;
    const held = { assignment: assignment.id, token: assignment.token };
    this.#stopBeating = beat(
      assignment.lease_seconds,
      () => this.#desk.renew(held),
      () => this.lose(),
    );
  }

  /** The lease is gone: say so and go on. */
  lose(): void {
    if (this.phase !== 'task') return;
    this.#forget();
    this.#warn(
      'The time on that query ran out, so it went back to the queue. Nothing was charged and nothing is wrong; here is what comes next.',
    );
    void this.#lookForWork();
  }

  #turnAway(reason: Refused): void {
    this.phase = reason.status === 401 ? 'signed-out' : 'refused';
    this.#warn(reason.message);
  }

  #setAside(): void {
    this.#lookup.abort();
    const held = this.#held();
    if (held === null || this.phase === 'sending') return;
    this.#forget();
    void this.#giveBack(held);
  }

  async #giveBack(held: Held): Promise<void> {
    try {
      await this.#desk.release(held, '', false);
    } catch {
      // Its lease ends by itself.
    }
  }

  #forget(): void {
    this.#stopBeating();
    this.assignment = null;
  }

  #held(): Held | null {
    return this.assignment && { assignment: this.assignment.id, token: this.assignment.token };
  }

  #count(): void {
    if (this.me)
      this.me = { ...this.me, answers: this.me.answers + 1, answers_today: this.me.answers_today + 1 };
    if (performance.now() - this.#meAt > ME_EVERY_MS) void this.#refreshMe();
  }

  async #refreshMe(): Promise<void> {
    this.#meAt = performance.now();
    try {
      this.me = await this.#desk.me();
    } catch {
      // The numbers in the footer stay as they were.
    }
  }

  #warn(text: string, instead?: string): void {
    this.notice = { tone: 'warning', text: instead ?? text };
  }
}

const UNDO_REFUSED: Readonly<Record<string, string>> = {
  'answer-used': 'The learner has already used that answer, so it can no longer be taken back.',
  'run-finished': 'That run is finished, so its answers can no longer be taken back.',
};

function refusalWords(reason: Refused): string {
  if (reason.name === 'lease-expired') {
    return 'That answer came after the time on the query had run out. It is kept, but does not count and costs nothing.';
  }
  return `That answer was not taken: ${reason.message}`;
}

function newKey(assignment: number): string {
  const random = crypto.getRandomValues(new Uint32Array(2));
  return `answer-${assignment}-${[...random].map((part) => part.toString(16)).join('')}`;
}
