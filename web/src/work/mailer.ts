import { Refused } from '../api/client';
import type { Assignment, Lease, Receipt } from '../api/types';
import type { Letter, SendAnswer } from './desk';
import * as outboxes from './outbox';
import type { Outbox } from './outbox';

export interface MailListener {
  stored(): void;
  refused(reason: Refused): void;
}
const NOBODY: MailListener = { stored: () => undefined, refused: () => undefined };

/** Sends answers until the server has them. Nothing leaves the outbox without a receipt or a refusal. */
export class Mailer {
  readonly #send: SendAnswer;
  readonly #storage: Storage;
  readonly #changed: (outbox: Outbox) => void;
  #outbox: Outbox;
  #listener = NOBODY;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #underway = new Set<number>(); // assignments whose answer is being sent right now
  #flushing: Promise<Assignment | null> | null = null;

  constructor(send: SendAnswer, storage: Storage, changed: (outbox: Outbox) => void) {
    this.#send = send;
    this.#storage = storage;
    this.#changed = changed;
    this.#outbox = outboxes.load(storage);
    changed(this.#outbox);
  }

  /** Have somebody told what becomes of answers, until the returned function is called. */
  listen(listener: MailListener): () => void {
    this.#listener = listener;
    return () => {
      if (this.#listener === listener) this.#listener = NOBODY;
    };
  }

  /** The assignments whose answers the server does not have yet. */
  unsent(): number[] {
    return this.#outbox.map((letter) => letter.assignment);
  }

  /** Send an answer now; null when it is refused or has to be tried again. */
  async send(letter: Letter, next: Lease): Promise<Receipt | null> {
    this.#set(outboxes.add(this.#outbox, letter));
    return this.#try(letter, next);
  }

  /**
   * Try what is still here, oldest first, and stop where the server cannot be reached. With `next`, returns the
   * assignment that came with the last receipt: a receipt that was lost on its way may have leased one.
   */
  flush(next: Lease | null): Promise<Assignment | null> {
    this.#flushing ??= this.#flush(next).finally(() => (this.#flushing = null));
    return this.#flushing;
  }

  async #flush(next: Lease | null): Promise<Assignment | null> {
    const letters = this.#outbox.filter((letter) => !this.#underway.has(letter.assignment));
    for (const [index, letter] of letters.entries()) {
      const isLast = index === letters.length - 1;
      const receipt = await this.#try(letter, isLast ? next : null);
      if (isLast) return receipt?.next ?? null;
      if (this.#outbox.some((kept) => kept.assignment === letter.assignment)) return null;
    }
    return null;
  }

  async #try(letter: Letter, next: Lease | null): Promise<Receipt | null> {
    this.#underway.add(letter.assignment);
    try {
      const receipt = await this.#send(letter, next);
      this.#set(outboxes.without(this.#outbox, letter.assignment));
      this.#listener.stored();
      return receipt;
    } catch (error) {
      if (error instanceof Refused && error.status !== 401) {
        this.#set(outboxes.without(this.#outbox, letter.assignment));
        this.#listener.refused(error);
      } else {
        this.#set(outboxes.attempted(this.#outbox, letter.assignment));
        this.#tryLater(letter.attempts + 1);
      }
      return null;
    } finally {
      this.#underway.delete(letter.assignment);
    }
  }

  #tryLater(attempts: number): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.flush(null), outboxes.delay(attempts));
  }

  #set(outbox: Outbox): void {
    this.#outbox = outbox;
    outboxes.save(this.#storage, outbox);
    this.#changed(outbox);
  }
}
