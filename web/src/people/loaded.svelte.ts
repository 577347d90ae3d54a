import { Refused, wordsOf } from '../api/client';

/** Something the server was asked for, and what came of asking it to change. */
export class Loaded<T> {
  value: T | null = $state.raw(null);
  problem: string | null = $state(null);
  status: number | null = $state(null); // of a refusal
  readonly #load: () => Promise<T>;

  constructor(load: () => Promise<T>) {
    this.#load = load;
  }

  async again(): Promise<void> {
    await this.try(() => Promise.resolve());
  }

  /** Do something and look again; what goes wrong is said, and false returned. */
  async try(change: () => Promise<unknown>): Promise<boolean> {
    try {
      await change();
      this.value = await this.#load();
      this.problem = null;
      return true;
    } catch (error) {
      this.status = error instanceof Refused ? error.status : null;
      this.problem =
        error instanceof Refused ? error.message : `${wordsOf(error).split('.')[0]}. Nothing was changed.`;
      return false;
    }
  }
}
