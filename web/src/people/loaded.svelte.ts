import { Refused } from '../api/client';

/** Something the server was asked for, and what came of asking it to change. */
export class Loaded<T> {
  value: T | null = $state.raw(null);
  problem: string | null = $state(null);
  status: number | null = $state(null); // of a refusal
  readonly #load: () => Promise<T>;

  constructor(load: () => Promise<T>) {
    this.#load = load;
  }

  async again(): Promise<boolean> {
    return this.#attempt(async () => {
      this.value = await this.#load();
    }, 'The server cannot be reached.');
  }

  /** Do something and look again; what goes wrong is said, and false returned. */
  async try(change: () => Promise<unknown>): Promise<boolean> {
    const done = await this.#attempt(
      change,
      'The server cannot be reached, so it may not be done. Try again.',
    );
    return done && this.again();
  }

  async #attempt(work: () => Promise<unknown>, unreached: string): Promise<boolean> {
    try {
      await work();
      this.problem = null;
      return true;
    } catch (error) {
      this.status = error instanceof Refused ? error.status : null;
      this.problem = error instanceof Refused ? error.message : unreached;
      return false;
    }
  }
}
