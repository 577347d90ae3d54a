import { isAborted, Refused, wordsOf } from './client';

/** Something from the server: what came last stays while the next is under way, so nothing flickers. */
export class Loaded<T> {
  value: T | null = $state.raw(null);
  problem: string | null = $state(null);
  isMissing = $state(false);
  #turn = 0;

  /** Load; of several at once the last one asked for counts. */
  async load(call: () => Promise<T>): Promise<void> {
    const turn = ++this.#turn;
    try {
      const value = await call();
      if (turn !== this.#turn) return;
      this.value = value;
      this.problem = null;
      this.isMissing = false;
    } catch (error) {
      if (turn !== this.#turn || isAborted(error)) return;
      this.isMissing = error instanceof Refused && error.status === 404;
      this.problem = wordsOf(error);
    }
  }
}
