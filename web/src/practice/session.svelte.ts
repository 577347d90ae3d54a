import { api, unwrap, wordsOf } from '../api/client';
import type { Answer, Answerable, Assignment, Feedback, Practice, Run } from '../api/types';

export type Phase = 'loading' | 'intro' | 'question' | 'feedback' | 'done' | 'failed';

/** Somebody practicing: one question after the other, each followed by what was right. Nothing is stored. */
export class PracticeSession {
  phase: Phase = $state('loading');
  place = $state(0);
  shown = $state(0); // how many questions have been put on the screen
  feedback: Feedback | null = $state.raw(null);
  problem: string | null = $state(null);
  results: readonly boolean[] = $state.raw([]); // by place, of this round
  #practice: Practice | null = $state.raw(null);

  readonly total = $derived(this.#asks().length);
  readonly right = $derived(this.results.filter(Boolean).length);
  readonly ask: Answerable | null = $derived(this.#asks()[this.place]?.ask ?? null);
  /** The question, as the work view is given one. */
  readonly assignment: Assignment | null = $derived(this.#assignment());

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
    const query = this.#asks()[this.place]?.id;
    if (query === undefined || this.phase !== 'question') return;
    try {
      const params = { path: { query } };
      this.feedback = await unwrap(api.POST('/api/v1/practice/{query}', { params, body: { answer } }));
      this.results = [...this.results.slice(0, this.place), this.feedback.is_right];
      this.problem = null;
      this.phase = 'feedback';
    } catch (error) {
      this.problem = wordsOf(error);
    }
  }

  /** Go on without an answer, which counts as not right. */
  skip(): void {
    this.results = [...this.results.slice(0, this.place), false];
    this.next();
  }

  next(): void {
    if (this.place + 1 < this.total) this.#show(this.place + 1);
    else this.phase = 'done';
  }

  /** Answer the question before again. */
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

  /** Demonstrations need a learner's environment, so there are none here. */
  #asks(): readonly { id: number; ask: Answerable }[] {
    const queries = this.#practice?.queries ?? [];
    return queries.flatMap(({ id, ask }) => (ask.kind === 'hier_demo' ? [] : [{ id, ask }]));
  }

  #assignment(): Assignment | null {
    if (this.#practice === null || this.ask === null) return null;
    const query = {
      id: -this.shown, // no query of the server's, and no other showing's draft
      run: '',
      state: 'leased' as const,
      priority: 0,
      created_at: 0,
      ask: this.ask,
      answer: null,
      answer_id: null,
      used: false,
      annotator: null,
      units: null,
      seconds: null,
      active_seconds: null,
    };
    const run = rehearsal(this.#practice);
    return { id: query.id, token: '', query, run, leased_at: 0, expires_at: 0, lease_seconds: 0 };
  }
}

/** A run in which nothing costs anything. */
function rehearsal({ vocabulary }: Practice): Run {
  return {
    id: '',
    name: 'practice',
    algorithm: '',
    seed: 0,
    state: 'running',
    priority: 0,
    vocabulary,
    config: {},
    prices: { subgoal: 0, action: 0, termination: 0, inspect_full: 0, inspect_lo: 0 },
    budget: null,
    reserved: 0,
    spent: 0,
    episodes: null,
    episodes_done: 0,
    success_rate: null,
    open_queries: 0,
    gold_rate: 0,
    result: null,
    created_at: 0,
    finished_at: null,
  };
}
