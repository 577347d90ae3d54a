// Sends answers until the server has stored or refused them. No answer leaves the outbox before that.
import { Refused } from '../../api/client';
import { delay } from '../../api/retry';
import type { Assignment, LeaseRequest, Receipt } from '../../api/types';
import * as outboxes from './outbox';
import type { Outbox, PendingAnswer } from './outbox';

/** Store an answer on the server. With `next`, the receipt brings the next query. */
export type SendAnswer = (pending: PendingAnswer, next: LeaseRequest | null) => Promise<Receipt>;

export interface AnswerListener {
  stored(receipt: Receipt): void;
  refused(reason: Refused, assignment: number): void;
}
const NOBODY: AnswerListener = { stored: () => undefined, refused: () => undefined };

/** Called when the outbox has changed; `isKept`: it would survive a reload. */
export type OutboxListener = (outbox: Outbox, isKept: boolean) => void;

export class AnswerSender {
  readonly #send: SendAnswer;
  readonly #storage: Storage;
  readonly #changed: OutboxListener;
  #outbox: Outbox;
  #listener = NOBODY;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #underway = new Set<number>(); // assignments whose answer is being sent right now
  #flushing: Promise<Assignment | null> | null = null;

  constructor(send: SendAnswer, storage: Storage, changed: OutboxListener) {
    this.#send = send;
    this.#storage = storage;
    this.#changed = changed;
    this.#outbox = outboxes.load(storage);
    changed(this.#outbox, true);
  }

  /** Tell the listener which answers are stored or refused, until the returned function is called. */
  listen(listener: AnswerListener): () => void {
    this.#listener = listener;
    return () => {
      if (this.#listener === listener) this.#listener = NOBODY;
    };
  }

  /** Return the assignments whose answers the server does not have yet. */
  unsent(): number[] {
    return this.#outbox.map((pending) => pending.assignment);
  }

  /** Send an answer now. Return null when it is refused or must be sent again later. */
  async send(pending: PendingAnswer, next: LeaseRequest): Promise<Receipt | null> {
    this.#set(outboxes.add(this.#outbox, pending));
    return this.#try(pending, next);
  }

  /**
   * Send everything in the outbox, oldest first, and stop where the server cannot be reached. With `next`, return the
   * assignment that came with the last receipt: an earlier receipt that was lost may have leased one.
   */
  flush(next: LeaseRequest | null): Promise<Assignment | null> {
    this.#flushing ??= this.#flush(next).finally(() => (this.#flushing = null));
    return this.#flushing;
  }

  async #flush(next: LeaseRequest | null): Promise<Assignment | null> {
    const waiting = this.#outbox.filter((pending) => !this.#underway.has(pending.assignment));
    for (const [index, pending] of waiting.entries()) {
      const isLast = index === waiting.length - 1;
      const receipt = await this.#try(pending, isLast ? next : null);
      if (isLast) return receipt?.next ?? null;
      if (this.#outbox.some((kept) => kept.assignment === pending.assignment)) return null;
    }
    return null;
  }

  async #try(pending: PendingAnswer, next: LeaseRequest | null): Promise<Receipt | null> {
    this.#underway.add(pending.assignment);
    try {
      const receipt = await this.#send(pending, next);
      this.#set(outboxes.without(this.#outbox, pending.assignment));
      this.#listener.stored(receipt);
      return receipt;
    } catch (error) {
      if (error instanceof Refused && error.status !== 401) {
        this.#set(outboxes.without(this.#outbox, pending.assignment));
        this.#listener.refused(error, pending.assignment);
      } else {
        this.#set(outboxes.attempted(this.#outbox, pending.assignment));
        this.#tryLater(pending.attempts + 1);
      }
      return null;
    } finally {
      this.#underway.delete(pending.assignment);
    }
  }

  #tryLater(attempts: number): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.flush(null), delay(attempts));
  }

  #set(outbox: Outbox): void {
    this.#outbox = outbox;
    this.#changed(outbox, outboxes.save(this.#storage, outbox));
  }
}
