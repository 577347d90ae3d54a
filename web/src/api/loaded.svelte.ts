// A value that a view loads from the server, or the reason why there is none.
import { t } from '../language/language';
import { isAborted, Refused, tryingAgain, wordsOf } from './client';

interface Options {
  /** Whether the view reloads its data automatically; error messages then say so. */
  readonly live?: boolean;
}

/** A value from the server. The last value stays while the next one is loaded, so that nothing flickers. */
export class Loaded<T> {
  value: T | null = $state.raw(null);
  problem: string | null = $state(null); // what to tell the person
  status: number | null = $state(null); // of the server's refusal
  readonly #fetch: () => Promise<T>;
  readonly #unreachable: string | undefined;
  #turn = 0;

  constructor(fetch: () => Promise<T>, { live = false }: Options = {}) {
    this.#fetch = fetch;
    if (live) this.#unreachable = tryingAgain();
  }

  get isMissing(): boolean {
    return this.status === 404;
  }

  /** Load the value and return whether that worked. If several loads overlap, only the last one counts. */
  async load(): Promise<boolean> {
    const turn = ++this.#turn;
    try {
      const value = await this.#fetch();
      if (turn === this.#turn) {
        this.value = value;
        this.#settle(null, null);
      }
      return true;
    } catch (error) {
      if (turn === this.#turn && !isAborted(error)) this.#fail(error, this.#unreachable);
      return false;
    }
  }

  /** Change something on the server, then load again. Return whether both worked. */
  async change(request: () => Promise<unknown>): Promise<boolean> {
    try {
      await request();
    } catch (error) {
      this.#fail(error, t('The server cannot be reached, so the change may not be saved. Try again.'));
      return false;
    }
    return this.load();
  }

  #fail(error: unknown, unreachable: string | undefined): void {
    this.#settle(wordsOf(error, unreachable), error instanceof Refused ? error.status : null);
  }

  #settle(problem: string | null, status: number | null): void {
    this.problem = problem;
    this.status = status;
  }
}
