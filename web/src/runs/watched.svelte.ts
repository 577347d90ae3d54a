// A run that is kept up to date while it is on the screen.
import { api, Refused, tryingAgain, unwrap, wordsOf } from '../api/client';
import type { Costs, Curves, Run } from '../api/types';
import { updatedCurves } from './curves/curves';
import { throttled, watch, type RunEvent } from '../api/live';

const REFRESH_MS = 1_000;
const MOST = 1_000; // episodes to draw, about one for each pixel; the server's http/ahead.py has the same number

type Part = 'run' | 'costs' | 'curves' | 'queries' | 'ledger';
const PARTS: readonly Part[] = ['run', 'costs', 'curves', 'queries', 'ledger'];
/** The parts that an event makes stale. */
const STALE: Readonly<Record<RunEvent, readonly Part[]>> = {
  asked: ['run', 'queries'],
  answered: ['run', 'costs', 'queries', 'ledger'],
  retracted: ['run', 'costs', 'queries', 'ledger'],
  used: ['queries'],
  cancelled: ['run', 'queries'],
  episode: ['run', 'costs', 'curves'],
  run: ['run'],
};

type Changes = Pick<Run, 'name' | 'budget' | 'priority'> & { state: Run['state'] };

export class WatchedRun {
  run: Run | null = $state.raw(null);
  curves: Curves | null = $state.raw(null);
  costs: Costs | null = $state.raw(null);
  problem: string | null = $state(null);
  isMissing = $state(false);
  isLive = $state(false);
  /** Counters that grow when the queries or the ledger have changed. */
  queriesChanged = $state(0);
  ledgerChanged = $state(0);

  readonly #id: string;
  // eslint-disable-next-line svelte/prefer-svelte-reactivity -- nothing on the screen depends on it
  readonly #stale = new Set<Part>(PARTS);
  #missed = false; // events may be missing: load the curves from their beginning
  #stopped = false;

  constructor(id: string) {
    this.#id = id;
  }

  /** Keep the run up to date until the returned function is called. */
  start(): () => void {
    const load = throttled(() => this.#load(), REFRESH_MS);
    load();
    const close = watch(this.#id, {
      changed: (event) => {
        for (const part of event === null ? PARTS : STALE[event]) this.#stale.add(part);
        if (event === null) this.#missed = true;
        load();
      },
      connected: (isLive) => (this.isLive = isLive),
    });
    return () => {
      this.#stopped = true;
      close();
    };
  }

  /** Change the run; throw the server's refusal. */
  async change(changes: Partial<Changes>): Promise<void> {
    const params = { path: { run: this.#id } };
    this.run = await unwrap(api.PATCH('/api/v1/runs/{run}', { params, body: changes }));
  }

  async #load(): Promise<void> {
    if (this.#stopped) return;
    const stale = [...this.#stale];
    this.#stale.clear();
    try {
      await Promise.all(stale.map((part) => this.#loadPart(part)));
      this.problem = null;
    } catch (error) {
      for (const part of stale) this.#stale.add(part);
      this.isMissing = error instanceof Refused && error.status === 404;
      this.problem = wordsOf(error, tryingAgain());
    }
  }

  async #loadPart(part: Part): Promise<void> {
    const path = { run: this.#id };
    if (part === 'queries') this.queriesChanged++;
    else if (part === 'ledger') this.ledgerChanged++;
    else if (part === 'run') this.run = await unwrap(api.GET('/api/v1/runs/{run}', { params: { path } }));
    else if (part === 'costs')
      this.costs = await unwrap(api.GET('/api/v1/runs/{run}/costs', { params: { path } }));
    else await this.#loadCurves();
  }

  async #loadCurves(): Promise<void> {
    const known = this.#missed ? null : this.curves;
    this.#missed = false;
    this.curves = await updatedCurves(this.#id, known, MOST);
  }
}
