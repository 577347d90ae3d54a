// A practice session: one query after the other, each with feedback. Nothing is stored.
import { api, unwrap, wordsOf } from '../api/client';
import type { Answer, Answerable, Feedback, Practice, Vocabulary } from '../api/types';

export type Phase = 'loading' | 'intro' | 'question' | 'feedback' | 'done' | 'failed';

interface PracticeQuery {
  readonly id: number;
  readonly ask: Answerable;
}

export class PracticeSession {
  phase: Phase = $state('loading');
  place = $state(0);
  shown = $state(0); // how many queries have been on the screen
  feedback: Feedback | null = $state.raw(null);
  problem: string | null = $state(null);
  results: readonly boolean[] = $state.raw([]); // by place, of this round
  #practice: Practice | null = $state.raw(null);

  readonly total = $derived(this.#queries().length);
  readonly right = $derived(this.results.filter(Boolean).length);
  readonly query: PracticeQuery | null = $derived(this.#queries()[this.place] ?? null);
  readonly vocabulary: Vocabulary | null = $derived(this.#practice?.vocabulary ?? null);

  async load(): Promise<void> {
    this.phase = 'loading';
    try {
      this.#practice = await unwrap(api.GET('/api/v1/practice'));
      this.phase = 'intro';
    } catch (error) {
      this.problem = wordsOf(error);
      this.phase = 'failed';
    }
  }

  /** Begin, or begin again. */
  start(): void {
    this.results = [];
    this.#show(0);
  }

  async submit(answer: Answer): Promise<void> {
    if (this.query === null || this.phase !== 'question') return;
    try {
      const params = { path: { query: this.query.id } };
      this.feedback = await unwrap(api.POST('/api/v1/practice/{query}', { params, body: { answer } }));
      this.results = [...this.results.slice(0, this.place), this.feedback.is_right];
      this.problem = null;
      this.phase = 'feedback';
    } catch (error) {
      this.problem = wordsOf(error);
    }
  }

  /** Go to the next query without an answer, which counts as wrong. */
  skip(): void {
    this.results = [...this.results.slice(0, this.place), false];
    this.next();
  }

  next(): void {
    if (this.place + 1 < this.total) this.#show(this.place + 1);
    else this.phase = 'done';
  }

  /** After the feedback, answer this query again; before it, go back to the previous query. */
  back(): void {
    this.#show(Math.max(0, this.place - (this.phase === 'question' ? 1 : 0)));
  }

  #show(place: number): void {
    this.place = place;
    this.shown += 1;
    this.feedback = null;
    this.problem = null;
    this.phase = 'question';
  }

  /** Return the queries of the practice file except demonstrations, which need a learner's environment. */
  #queries(): readonly PracticeQuery[] {
    const queries = this.#practice?.queries ?? [];
    return queries.flatMap(({ id, ask }) => (ask.kind === 'hier_demo' ? [] : [{ id, ask }]));
  }
}
