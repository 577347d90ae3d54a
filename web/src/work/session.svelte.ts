import { isAborted, Refused, Unreachable, wordsOf } from '../api/client';
import type { Answer, Assignment, Me } from '../api/types';
import { heldOf, wish, type Desk, type Held, type Letter } from './desk';
import { beat, NO_HEARTBEAT, pause, visible, type Heartbeat } from './heartbeat';
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
/** Queries held besides the one on the screen, so that the next is there at once. */
const MOST_AHEAD = 2;
const ME_EVERY_MS = 5_000;

/** What is leased and waits for its turn. */
interface Ahead {
  readonly assignment: Assignment;
  readonly heartbeat: Heartbeat;
}

/**
 * One annotator at work: leases a query, keeps the lease, sends the answer, goes on to the next. What comes next is
 * leased ahead where enough is asked, so that it is on the screen before the answer has arrived.
 */
export class WorkSession {
  phase: Phase = $state('loading');
  assignment: Assignment | null = $state.raw(null);
  shown = $state(0); // how many queries have been put on the screen
  notice: Notice | null = $state.raw(null);
  me: Me | null = $state.raw(null);

  readonly #desk: Desk;
  readonly #mailer: Mailer;
  readonly #run: string | null; // only this run's queries
  readonly #active: () => boolean; // has the annotator done anything since it was last asked?
  readonly #prepare: (assignment: Assignment) => void; // load what a query shows
  readonly #stopListening: () => void;
  #lookup = new AbortController();
  #lookupAhead = new AbortController();
  #heartbeat = NO_HEARTBEAT;
  #tab = newName('page');
  #ahead: readonly Ahead[] = [];
  #expected = 0; // requests under way that may bring a query to be kept ahead
  #sending: Promise<unknown> = Promise.resolve();
  #sent: readonly Held[] = []; // what can be undone, oldest first
  #stopped = false;
  #stored = 0; // answers, since the page was opened
  #meAt = 0;

  constructor(
    desk: Desk,
    mailer: Mailer,
    run: string | null,
    active: () => boolean,
    prepare: (assignment: Assignment) => void,
  ) {
    this.#desk = desk;
    this.#mailer = mailer;
    this.#run = run;
    this.#active = active;
    this.#prepare = prepare;
    this.#stopListening = mailer.listen({
      stored: () => this.#count(),
      refused: (reason) => this.#refused(reason),
    });
  }

  start(): void {
    void this.#refreshMe();
    void this.#lookForWork();
  }

  /** Give back what is held and stop asking. What is unsaved goes on being sent. */
  stop(): void {
    this.#stopped = true;
    this.#stopListening();
    this.#setAside();
  }

  /** The page is going, perhaps for good: give back what is held. */
  leave(): void {
    this.#setAside();
  }

  /** The page is back, out of the browser's memory of it. */
  resume(): void {
    this.#tab = newName('page');
    if (this.assignment === null) void this.#lookForWork();
  }

  submit(answer: Answer): void {
    if (this.assignment === null || this.phase !== 'task') return;
    const held = heldOf(this.assignment);
    this.#heartbeat.stop();
    this.notice = null;
    this.phase = 'sending';
    const sent = this.#send({ ...held, answer, key: newName(`answer-${held.assignment}`), attempts: 0 });
    this.#sending = Promise.all([this.#sending, sent]);
    this.#showAhead();
  }

  async skip(reason: string): Promise<void> {
    const skipped = this.assignment;
    if (skipped === null || this.phase !== 'task') return;
    this.phase = 'sending';
    try {
      await this.#desk.release(heldOf(skipped), reason, true);
      this.notice = { tone: 'info', text: 'Skipped. It will not be offered to you again.' };
    } catch (error) {
      if (error instanceof Unreachable) {
        this.phase = 'task';
        this.#warn('The server cannot be reached, so the query is not skipped yet. Try again in a moment.');
        return;
      }
    }
    if (this.assignment !== skipped) return; // what came meanwhile is on the screen
    this.#forget();
    this.#goOn();
  }

  async undo(): Promise<void> {
    await this.#sending;
    const last = this.#sent.at(-1);
    if (last === undefined) {
      this.notice = { tone: 'info', text: 'There is no answer to take back yet.' };
      return;
    }
    try {
      const assignment = await this.#desk.retract(last, this.#tab);
      this.#sent = this.#sent.slice(0, -1);
      this.#postpone();
      this.#show(assignment);
      this.notice = { tone: 'info', text: 'Taken back. Answer it again.' };
    } catch (error) {
      this.#warn(wordsOf(error), error instanceof Refused ? UNDO_REFUSED[error.name] : undefined);
    }
  }

  async #send(letter: Letter): Promise<void> {
    const isNextThere = this.#ahead.length > 0;
    const next = wish(this.#run, this.#tab, isNextThere ? 0 : NEXT_SECONDS, isNextThere);
    const receipt = await this.#expecting(this.#mailer.send(letter, next));
    if (receipt !== null) this.#sent = [...this.#sent, letter].slice(-UNDO_DEPTH);
    if (receipt?.next) this.#receive(receipt.next);
    else if (this.phase === 'sending') {
      this.#forget();
      this.#goOn();
    } else if (receipt !== null) void this.#lookAhead();
  }

  /** Go on to what is held, or look for something. */
  #goOn(): void {
    if (!this.#showAhead()) void this.#lookForWork();
  }

  /** An assignment has come: show it, keep it for later, or give it back. */
  #receive(assignment: Assignment): void {
    if (this.#stopped) void this.#giveBack(heldOf(assignment));
    else if (this.phase === 'task') this.#keepAhead(assignment);
    else this.#show(assignment);
  }

  /** Show what was leased ahead, if something was. */
  #showAhead(): boolean {
    const [first, ...rest] = this.#ahead;
    if (first === undefined) return false;
    this.#ahead = rest;
    first.heartbeat.stop();
    this.#show(first.assignment);
    return true;
  }

  /** Hold an assignment until its turn: the episode on the screen first, then as the server hands out. */
  #keepAhead(assignment: Assignment): void {
    this.#prepare(assignment);
    const isOther = (one: Assignment): number => Number(!followsUp(one, this.assignment));
    this.#hold(
      [...this.#waiting(), assignment].toSorted(
        (a, b) => isOther(a) - isOther(b) || b.query.priority - a.query.priority || a.query.id - b.query.id,
      ),
    );
  }

  #waiting(): Assignment[] {
    return this.#ahead.map((one) => one.assignment);
  }

  /** Hold these, in this order, and give back those that are too many. */
  #hold(assignments: readonly Assignment[]): void {
    for (const one of this.#ahead) one.heartbeat.stop();
    this.#ahead = assignments.slice(0, MOST_AHEAD).map((assignment) => ({
      assignment,
      heartbeat: beat(
        assignment.lease_seconds,
        () => this.#desk.renew(heldOf(assignment), false),
        () => (this.#ahead = this.#ahead.filter((one) => one.assignment !== assignment)),
      ),
    }));
    for (const assignment of assignments.slice(MOST_AHEAD)) void this.#giveBack(heldOf(assignment));
  }

  /** What is on the screen comes back after what is shown instead. */
  #postpone(): void {
    const { assignment } = this;
    if (assignment === null || this.phase !== 'task') return;
    this.#forget();
    this.#hold([assignment, ...this.#waiting()]);
  }

  /** Lease the next query while this one is looked at, unless one is there or on its way. */
  async #lookAhead(): Promise<void> {
    if (this.#ahead.length > 0 || this.#expected > 0 || this.phase !== 'task') return;
    const { signal } = (this.#lookupAhead = new AbortController());
    try {
      const found = await this.#expecting(
        this.#desk.lease(wish(this.#run, this.#tab, POLL_SECONDS, true), signal),
      );
      if (found !== null) this.#receive(found);
    } catch {
      // The next query comes with the receipt.
    }
  }

  async #expecting<T>(reply: Promise<T>): Promise<T> {
    this.#expected += 1;
    try {
      return await reply;
    } finally {
      this.#expected -= 1;
    }
  }

  async #lookForWork(): Promise<void> {
    this.#lookup.abort();
    const { signal } = (this.#lookup = new AbortController());
    let [attempts, wait] = [0, 0];
    while (!signal.aborted && !this.#stopped) {
      try {
        await visible(signal);
        const found =
          (await this.#mailer.flush(wish(this.#run, this.#tab, 0))) ??
          (await this.#desk.lease(wish(this.#run, this.#tab, wait), signal));
        if (found !== null) return this.#receive(found);
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
    this.#lookup.abort();
    this.#heartbeat.stop();
    this.assignment = assignment;
    this.phase = 'task';
    this.shown += 1;
    const held = heldOf(assignment);
    this.#heartbeat = beat(
      assignment.lease_seconds,
      () => this.#desk.renew(held, this.#active()),
      () => this.lose(),
    );
    void this.#lookAhead();
  }

  /** The lease is gone: say so and go on. */
  lose(): void {
    if (this.phase !== 'task') return;
    this.#forget();
    this.#warn(
      'The time on that query ran out, so it went back to the queue. Nothing was charged and nothing is wrong; here is what comes next.',
    );
    this.#goOn();
    this.#heartbeat.now(); // what was held for later may be gone too
  }

  #refused(reason: Refused): void {
    this.#warn(refusalWords(reason));
    this.#heartbeat.now();
  }

  #turnAway(reason: Refused): void {
    this.phase = reason.status === 401 ? 'signed-out' : 'refused';
    this.#warn(reason.message);
  }

  /** Give back what was leased, and what is being leased, to this page; not what is being answered. */
  #setAside(): void {
    this.#lookup.abort();
    this.#lookupAhead.abort();
    this.#hold([]);
    if (this.phase !== 'sending') this.#forget();
    this.#desk.leave(this.#tab, this.#mailer.unsent()).catch(() => undefined); // the leases end by themselves
  }

  async #giveBack(held: Held): Promise<void> {
    try {
      await this.#desk.release(held, '', false);
    } catch {
      // Its lease ends by itself.
    }
  }

  #forget(): void {
    this.#heartbeat.stop();
    this.assignment = null;
    this.phase = 'loading';
  }

  #count(): void {
    this.#stored += 1;
    if (this.me)
      this.me = { ...this.me, answers: this.me.answers + 1, answers_today: this.me.answers_today + 1 };
    if (performance.now() - this.#meAt > ME_EVERY_MS) void this.#refreshMe();
  }

  async #refreshMe(): Promise<void> {
    this.#meAt = performance.now();
    const stored = this.#stored;
    try {
      const me = await this.#desk.me();
      if (stored === this.#stored) this.me = me;
      else void this.#refreshMe(); // an answer was stored meanwhile, which these numbers may be without
    } catch {
      // The numbers in the footer stay as they were.
    }
  }

  #warn(text: string, instead?: string): void {
    this.notice = { tone: 'warning', text: instead ?? text };
  }
}

/** Is a query about the episode that is on the screen? */
function followsUp({ query }: Assignment, shown: Assignment | null): boolean {
  return shown !== null && query.run === shown.query.run && query.ask.episode === shown.query.ask.episode;
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

/** A name that nobody else has. */
function newName(what: string): string {
  const random = crypto.getRandomValues(new Uint32Array(2));
  return `${what}-${[...random].map((part) => part.toString(16)).join('')}`;
}
