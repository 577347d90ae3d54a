// One annotator at work: leases queries, keeps the leases, sends the answers.
import { t } from '../language/language';
import type { AnswerSender } from './answers/sender';
import type { PendingAnswer } from './answers/outbox';
import { isAborted, Refused, Unreachable, wordsOf } from '../api/client';
import { delay, pause, visible } from '../api/retry';
import type { Answer, Assignment, Me, Outlook, Receipt } from '../api/types';
import type { Notice } from '../task/notice';
import { giveBack, LeasedAhead } from './ahead';
import { beat, NO_HEARTBEAT } from './heartbeat';
import { leaseRequest, proofOf, type LeaseProof, type Wanted, type WorkServer } from './server';

export type Phase = 'loading' | 'waiting' | 'task' | 'sending' | 'offline' | 'signed-out' | 'refused';

const POLL_SECONDS = 20;
/** How long the server may delay a receipt, to send the learner's next query with it. */
const NEXT_SECONDS = 0.25;
const UNDO_DEPTH = 10;
const ME_EVERY_MS = 5_000;
const OUTLOOK_EVERY_MS = 15_000;

/**
 * The session of one work view: leases a query, renews the lease, sends the answer, shows the next query. The next
 * query is leased ahead if there are enough queries, so that it is shown before the server has stored the answer.
 */
export class WorkSession {
  phase: Phase = $state('loading');
  assignment: Assignment | null = $state.raw(null);
  shown = $state(0); // how many queries have been put on the screen
  notice: Notice | null = $state.raw(null);
  answered: Answer | null = $state.raw(null); // the last answer, as long as its toast is shown
  me: Me | null = $state.raw(null);
  outlook: Outlook | null = $state.raw(null);

  readonly #server: WorkServer;
  readonly #sender: AnswerSender;
  readonly #wanted: Wanted;
  readonly #active: () => boolean; // has the annotator done anything since the last call?
  readonly #stopListening: () => void;
  #lookup = new AbortController();
  #lookupAhead = new AbortController();
  #heartbeat = NO_HEARTBEAT;
  #tab = newName('tab');
  readonly #ahead: LeasedAhead;
  #expected = 0; // the number of requests in progress that may bring a query to lease ahead
  #sending: Promise<unknown> = Promise.resolve();
  #sent: readonly LeaseProof[] = []; // answers, oldest first, also those that the server does not have yet
  #stopped = false;
  #stored = 0; // the number of answers stored since the view was opened
  #meAt = 0;
  #outlookAt = -Infinity;

  constructor(
    server: WorkServer,
    sender: AnswerSender,
    wanted: Wanted,
    active: () => boolean,
    prepare: (assignment: Assignment) => void,
  ) {
    this.#server = server;
    this.#sender = sender;
    this.#wanted = wanted;
    this.#active = active;
    this.#ahead = new LeasedAhead(server, prepare);
    this.#stopListening = sender.listen({
      stored: (receipt) => this.#count(receipt),
      refused: (reason, assignment) => this.#refused(reason, assignment),
    });
  }

  start(): void {
    void this.#refreshMe();
    void this.#lookForWork();
  }

  /** Release all leases and stop asking for queries. Unsaved answers are still sent. */
  stop(): void {
    this.#stopped = true;
    this.#stopListening();
    this.#releaseAll();
  }

  /** Release all leases: the tab may be closing for good. */
  leave(): void {
    this.#releaseAll();
  }

  /** Work again: the browser has restored the view from its back/forward cache. */
  resume(): void {
    this.#tab = newName('tab');
    if (this.assignment === null) void this.#lookForWork();
  }

  submit(answer: Answer): void {
    if (this.assignment === null || this.phase !== 'task') return;
    const lease = proofOf(this.assignment);
    this.#heartbeat.stop();
    this.notice = null;
    this.answered = answer;
    this.phase = 'sending';
    this.#sent = [...this.#sent, lease].slice(-UNDO_DEPTH);
    const sent = this.#send({ ...lease, answer, key: newName(`answer-${lease.assignment}`), attempts: 0 });
    this.#sending = Promise.all([this.#sending, sent]);
    this.#showAhead();
  }

  async skip(reason: string): Promise<void> {
    const skipped = this.assignment;
    if (skipped === null || this.phase !== 'task') return;
    this.phase = 'sending';
    try {
      await this.#server.release(proofOf(skipped), reason, true);
      this.notice = { tone: 'info', text: t('Skipped. You will not be asked it again.') };
    } catch (error) {
      if (error instanceof Unreachable) {
        this.phase = 'task';
        this.#warn(
          t('The server cannot be reached, so the question is not skipped yet. Try again in a moment.'),
        );
        return;
      }
    }
    if (this.assignment !== skipped) return; // another query came meanwhile and is on the screen
    this.#forget();
    this.#goOn();
  }

  async undo(): Promise<void> {
    await this.#sending;
    const last = this.#sent.at(-1);
    if (last === undefined) {
      this.notice = { tone: 'info', text: t('There is no answer to take back yet.') };
      return;
    }
    if (this.#sender.unsent().includes(last.assignment)) {
      this.#warn(t('Your last answer is not saved yet, so it cannot be taken back. Try again in a moment.'));
      return;
    }
    this.answered = null;
    try {
      const assignment = await this.#server.retract(last, this.#tab);
      this.#sent = this.#sent.slice(0, -1);
      this.#postpone();
      this.#show(assignment);
      this.notice = { tone: 'info', text: t('Taken back. Answer it again.') };
    } catch (error) {
      this.#warn(wordsOf(error), error instanceof Refused ? undoRefused()[error.name] : undefined);
    }
  }

  /** Ask what the learners do. If several questions overlap, only the last one counts. */
  async refreshOutlook(): Promise<void> {
    const at = (this.#outlookAt = performance.now());
    try {
      const outlook = await this.#server.outlook(this.#wanted.run);
      if (at === this.#outlookAt) this.outlook = outlook;
    } catch {
      // The words stay as they were.
    }
  }

  async #send(pending: PendingAnswer): Promise<void> {
    const isNextThere = this.#ahead.size > 0;
    const next = leaseRequest(this.#wanted, this.#tab, isNextThere ? 0 : NEXT_SECONDS, isNextThere);
    const receipt = await this.#expecting(this.#sender.send(pending, next));
    if (receipt?.next) this.#receive(receipt.next);
    else if (this.phase === 'sending') {
      this.#forget();
      this.#goOn();
    } else if (receipt !== null) void this.#lookAhead();
  }

  /** Show the next query that is leased ahead, or look for one. */
  #goOn(): void {
    if (!this.#showAhead()) void this.#lookForWork();
  }

  /** Take an assignment that has arrived: show it, keep it ahead, or release it. */
  #receive(assignment: Assignment): void {
    if (this.#stopped) void giveBack(this.#server, assignment);
    else if (this.phase === 'task') {
      this.#ahead.add(assignment, this.assignment);
      void this.#lookAhead();
    } else this.#show(assignment);
  }

  /** Show the first query that is leased ahead; return whether there is one. */
  #showAhead(): boolean {
    const first = this.#ahead.take();
    if (first !== undefined) this.#show(first);
    return first !== undefined;
  }

  /** Keep the query on the screen as the first one ahead, because another query is shown before it. */
  #postpone(): void {
    const { assignment } = this;
    if (assignment === null || this.phase !== 'task') return;
    this.#forget();
    this.#ahead.putFirst(assignment);
  }

  /** Lease one query more ahead, unless enough are leased or one is requested. Only the first is worth a wait. */
  async #lookAhead(): Promise<void> {
    if (this.#ahead.isFull || this.#expected > 0 || this.phase !== 'task') return;
    const wait = this.#ahead.size === 0 ? POLL_SECONDS : 0;
    const { signal } = (this.#lookupAhead = new AbortController());
    try {
      const found = await this.#expecting(
        this.#server.lease(leaseRequest(this.#wanted, this.#tab, wait, true), signal),
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
          (await this.#sender.flush(leaseRequest(this.#wanted, this.#tab, 0))) ??
          (await this.#server.lease(leaseRequest(this.#wanted, this.#tab, wait), signal));
        if (found !== null) {
          this.#receive(found);
          return;
        }
        [attempts, wait] = [0, POLL_SECONDS];
        this.phase = 'waiting';
        void this.#refreshMe(); // it says who holds queries
        void this.refreshOutlook();
      } catch (error) {
        if (isAborted(error)) return;
        if (error instanceof Refused) {
          this.#turnAway(error);
          return;
        }
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
    const lease = proofOf(assignment);
    this.#heartbeat = beat(
      assignment.lease_seconds,
      () => this.#server.renew(lease, this.#active()),
      () => this.lose(),
    );
    void this.#lookAhead();
    if (performance.now() - this.#outlookAt > OUTLOOK_EVERY_MS) void this.refreshOutlook();
  }

  /** The lease is lost: tell the annotator and show the next query. */
  lose(): void {
    if (this.phase !== 'task') return;
    this.#forget();
    this.#warn(
      t('You were away for a while, so that question went back to the queue. The next one is here.'),
    );
    this.#goOn();
    this.#heartbeat.now(); // the leases ahead may be lost too
  }

  #refused(reason: Refused, assignment: number): void {
    this.#sent = this.#sent.filter((lease) => lease.assignment !== assignment);
    this.answered = null;
    this.#warn(refusalWords(reason));
    this.#heartbeat.now();
  }

  #turnAway(reason: Refused): void {
    this.phase = reason.status === 401 ? 'signed-out' : 'refused';
    this.#warn(reason.message);
  }

  /** Release every current and future lease of this tab, except those whose answers are being sent. */
  #releaseAll(): void {
    this.#lookup.abort();
    this.#lookupAhead.abort();
    this.#ahead.stop();
    if (this.phase !== 'sending') this.#forget();
    this.#server.leave(this.#tab, this.#sender.unsent()).catch(() => undefined); // otherwise the leases expire
  }

  #forget(): void {
    this.#heartbeat.stop();
    this.assignment = null;
    this.phase = 'loading';
  }

  #count(receipt: Receipt): void {
    this.#stored += 1;
    if (this.me)
      this.me = {
        ...this.me,
        answers: this.me.answers + 1,
        answers_today: this.me.answers_today + 1,
        active_seconds_today: this.me.active_seconds_today + receipt.active_seconds,
      };
    if (performance.now() - this.#meAt > ME_EVERY_MS) void this.#refreshMe();
  }

  async #refreshMe(): Promise<void> {
    this.#meAt = performance.now();
    const stored = this.#stored;
    try {
      const me = await this.#server.me();
      if (stored === this.#stored) this.me = me;
      else void this.#refreshMe(); // an answer was stored meanwhile; these numbers may not count it
    } catch {
      // The numbers in the footer stay as they were.
    }
  }

  #warn(text: string, instead?: string): void {
    this.notice = { tone: 'warning', text: instead ?? text };
  }
}

/** Return why an answer cannot be taken back, by the name of the refusal. */
function undoRefused(): Readonly<Record<string, string>> {
  return {
    'answer-used': t('The learner has already used that answer, so it can no longer be taken back.'),
    'run-finished': t('That run is finished, so its answers can no longer be taken back.'),
  };
}

function refusalWords(reason: Refused): string {
  if (reason.name === 'lease-expired') {
    return t(
      'That answer came too late: the question had gone back to the queue. It is kept, but it does not count.',
    );
  }
  return t(`The server did not accept that answer: ${reason.message}`);
}

/** Return a unique name that begins with a word. */
function newName(what: string): string {
  const random = crypto.getRandomValues(new Uint32Array(2));
  return `${what}-${[...random].map((part) => part.toString(16)).join('')}`;
}
