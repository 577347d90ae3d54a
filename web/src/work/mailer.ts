import { Refused } from '../api/client';
import type { Assignment, Receipt } from '../api/types';
import type { Desk, Letter } from './desk';
import * as outboxes from './outbox';
import type { Outbox } from './outbox';

export interface MailerEvents {
  changed(outbox: Outbox): void;
  stored(receipt: Receipt): void;
  refused(letter: Letter, reason: Refused): void;
}

/** Sends answers until the server has them. Nothing leaves the outbox without a receipt or a refusal. */
export class Mailer {
  #outbox: Outbox;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #flushing: Promise<Assignment | null> | null = null;

  constructor(
    private readonly desk: Desk,
    private readonly storage: Storage,
    private readonly events: MailerEvents,
  ) {
    this.#outbox = outboxes.load(storage);
    events.changed(this.#outbox);
  }

  /** Send an answer now; null when it is refused or has to be tried again. */
  async send(letter: Letter): Promise<Receipt | null> {
    this.#set(outboxes.add(this.#outbox, letter));
    return this.#try(letter, true);
  }

  /**
   * Try what is still here, oldest first, and stop where the server cannot be reached. With `next`, returns the
   * assignment that came with the last receipt: a receipt that was lost on its way may have leased one.
   */
  flush(next: boolean): Promise<Assignment | null> {
    this.#flushing ??= this.#flush(next).finally(() => (this.#flushing = null));
    return this.#flushing;
  }

  stop(): void {
    clearTimeout(this.#timer);
  }

  async #flush(next: boolean): Promise<Assignment | null> {
    const letters = this.#outbox;
    for (const [index, letter] of letters.entries()) {
      const isLast = index === letters.length - 1;
      const receipt = await this.#try(letter, next && isLast);
      if (isLast) return receipt?.next ?? null;
      if (this.#outbox.some((kept) => kept.assignment === letter.assignment)) return null;
    }
    return null;
  }

  async #try(letter: Letter, next: boolean): Promise<Receipt | null> {
    try {
      const receipt = await this.desk.answer(letter, next);
      this.#set(outboxes.without(this.#outbox, letter.assignment));
      this.events.stored(receipt);
      return receipt;
    } catch (error) {
      if (error instanceof Refused && error.status !== 401) {
        this.#set(outboxes.without(this.#outbox, letter.assignment));
        this.events.refused(letter, error);
      } else {
        this.#set(outboxes.attempted(this.#outbox, letter.assignment));
        this.#tryLater(letter.attempts + 1);
      }
      return null;
    }
  }

  #tryLater(attempts: number): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => void this.flush(false), outboxes.delay(attempts));
  }

  #set(outbox: Outbox): void {
    this.#outbox = outbox;
    outboxes.save(this.storage, outbox);
    this.events.changed(outbox);
  }
}
