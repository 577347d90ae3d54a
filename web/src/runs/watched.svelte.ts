import { api, Refused, unwrap, wordsOf } from '../api/client';
import type { Costs, Curves, Query, Run } from '../api/types';
import { shell } from '../ui/shell.svelte';
import { throttled, watch } from './live';

const REFRESH_MS = 1_000;
const RECENT = 12;

/** A run, kept up to date while somebody looks at it. */
export class WatchedRun {
  run: Run | null = $state.raw(null);
  curves: Curves | null = $state.raw(null);
  costs: Costs | null = $state.raw(null);
  recent: readonly Query[] = $state.raw([]);
  problem: string | null = $state(null);
  isMissing = $state(false);
  isLive = $state(false);

  readonly #id: string;
  #stopped = false;

  constructor(id: string) {
    this.#id = id;
  }

  /** Returns how to stop. */
  start(): () => void {
    const changed = throttled(() => this.#load(), REFRESH_MS);
    changed();
    const close = watch(this.#id, { changed, connected: (isLive) => (this.isLive = isLive) });
    return () => {
      this.#stopped = true;
      close();
    };
  }

  /** Pause or resume. */
  async setState(state: 'running' | 'paused'): Promise<void> {
    try {
      const params = { path: { run: this.#id } };
      this.run = await unwrap(api.PATCH('/api/v1/runs/{run}', { params, body: { state } }));
      this.problem = null;
    } catch (error) {
      this.problem = wordsOf(error);
    }
  }

  async #load(): Promise<void> {
    if (this.#stopped) return;
    const params = { path: { run: this.#id } };
    try {
      const [run, curves, costs, recent] = await Promise.all([
        unwrap(api.GET('/api/v1/runs/{run}', { params })),
        unwrap(api.GET('/api/v1/runs/{run}/curves', { params })),
        unwrap(api.GET('/api/v1/runs/{run}/costs', { params })),
        unwrap(api.GET('/api/v1/runs/{run}/queries', { params: { ...params, query: { limit: RECENT } } })),
      ]);
      Object.assign(this, { run, curves, costs, recent: recent.queries, problem: null });
    } catch (error) {
      this.isMissing = error instanceof Refused && error.status === 404;
      this.problem = wordsOf(error);
    }
  }
}

/** Know who is looking, for what they may do. */
export async function greet(): Promise<void> {
  if (shell.me !== null) return;
  try {
    shell.me = await unwrap(api.GET('/api/v1/me'));
  } catch {
    // The view itself says that nobody is signed in.
  }
}
