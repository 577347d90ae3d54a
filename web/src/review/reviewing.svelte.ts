// The answer under review, and the way from one answer to the next.
import { api, isAborted, unwrap, wordsOf } from '../api/client';
import type { Query, QueryHistory, ReviewPage, ReviewRow } from '../api/types';
import type { operations } from '../api/schema';

type Asked = NonNullable<operations['listReview']['parameters']['query']>;
/** The answers to review: those that match all of these. */
export type Filters = Pick<Asked, 'kind' | 'annotator' | 'disagrees'>;

/** An answer with its query, as it stands. */
export interface Shown {
  readonly row: ReviewRow;
  readonly query: Query;
  readonly history: QueryHistory;
}

export class Reviewing {
  shown: Shown | null = $state.raw(null);
  page: ReviewPage | null = $state.raw(null); // the page with this answer alone
  problem: string | null = $state(null); // what to tell the person
  readonly hasNext = $derived(this.shown !== null && this.shown.query.id > (this.page?.oldest ?? Infinity));
  readonly hasPrevious = $derived(this.shown !== null && this.shown.query.id < (this.page?.newest ?? 0));
  readonly #run: string;
  #turn = 0;

  constructor(run: string) {
    this.#run = run;
  }

  /** Show the newest answer that matches, or the answer to the query `at` where it matches. */
  open(filters: Filters, at: number | null): Promise<boolean> {
    return this.#load({ ...filters, before: at === null ? null : at + 1 }, true);
  }

  /** Show the next older answer; stay at the last one. Return whether there was one. */
  next(filters: Filters): Promise<boolean> {
    return this.#load({ ...filters, before: this.shown?.query.id ?? null }, false);
  }

  /** Show the next newer answer; stay at the first one. Return whether there was one. */
  previous(filters: Filters): Promise<boolean> {
    return this.#load({ ...filters, after: this.shown?.query.id ?? null }, false);
  }

  /** Load the query on the screen again. */
  async refresh(): Promise<void> {
    const { shown } = this;
    if (shown === null) return;
    const now = await this.#try(() => this.#details(shown.row));
    // In the meantime, another answer may have come on the screen.
    if (now && this.shown?.query.id === shown.query.id) this.shown = now;
  }

  async #load(query: Asked, isFirst: boolean): Promise<boolean> {
    const turn = ++this.#turn;
    const found = await this.#try(async () => {
      const params = { path: { run: this.#run }, query: { ...query, limit: 1 } };
      const page = await unwrap(api.GET('/api/v1/runs/{run}/review', { params }));
      const row = page.rows[0];
      return { page, shown: row ? await this.#details(row) : null };
    });
    if (!found || turn !== this.#turn) return false;
    this.page = found.page;
    if (found.shown || isFirst) this.shown = found.shown;
    return found.shown !== null;
  }

  async #details(row: ReviewRow): Promise<Shown> {
    const params = { path: { query: row.query.id } };
    const [query, history] = await Promise.all([
      unwrap(api.GET('/api/v1/queries/{query}', { params })),
      unwrap(api.GET('/api/v1/queries/{query}/history', { params })),
    ]);
    return { row, query, history };
  }

  async #try<T>(load: () => Promise<T>): Promise<T | null> {
    try {
      const loaded = await load();
      this.problem = null;
      return loaded;
    } catch (error) {
      if (!isAborted(error)) this.problem = wordsOf(error);
      return null;
    }
  }
}
