// A practice session: one query after the other, each with feedback. Nothing is stored.
import { api, unwrap, wordsOf } from '../api/client';
import type { Answer, Answerable, AnswerableKind, Feedback, Practice, Vocabulary } from '../api/types';
import { domainsToPractice, firstDemonstrations, firstQueries } from './first';
import type { Worked } from './worked';

/** `useless`: there is no practice of what the person will be asked. */
export type Phase =
  'loading' | 'intro' | 'example' | 'question' | 'feedback' | 'demonstration' | 'done' | 'failed' | 'useless';

interface PracticeQuery {
  readonly id: number;
  readonly ask: Answerable;
}

interface WorkedExample {
  readonly ask: Answerable;
  readonly feedback: Feedback;
}

export class PracticeSession {
  phase: Phase = $state('loading');
  place = $state(0);
  shown = $state(0); // how many queries have been on the screen
  feedback: Feedback | null = $state.raw(null);
  problem: string | null = $state(null);
  results: readonly boolean[] = $state.raw([]); // by place, of this round
  example: WorkedExample | null = $state.raw(null); // of the phase `example`
  demonstrations: readonly Worked[] = $state.raw([]); // to look at after the last question; the first one is next
  #practice: Practice | null = $state.raw(null);
  readonly #isFirst: boolean;
  #examples: readonly WorkedExample[] = []; // those that were not shown yet

  readonly total = $derived(this.#queries().length);
  readonly right = $derived(this.results.filter(Boolean).length);
  readonly query: PracticeQuery | null = $derived(this.#queries()[this.place] ?? null);
  readonly vocabulary: Vocabulary | null = $derived(this.#practice?.vocabulary ?? null);
  domains: readonly string[] = $state.raw([]); // to choose from
  readonly #run: string | null;

  /**
   * A session of all practice queries, or the first one of a person, with worked examples. If the person works on one
   * run, it is about the domain of that run.
   */
  constructor(isFirst: boolean, run: string | null) {
    this.#isFirst = isFirst;
    this.#run = run;
  }

  /** Load the practice of a domain; by default, of the first that the person may be asked about. */
  async load(domain?: string): Promise<void> {
    if (this.phase !== 'intro') this.phase = 'loading'; // the choice of the domain stays where it is
    try {
      const outlook = await unwrap(api.GET('/api/v1/outlook'));
      const usual = await practiceOf(domain);
      this.domains = domainsToPractice(usual, outlook, this.#run);
      const chosen = domain ?? this.domains[0];
      if (chosen === undefined) {
        this.phase = 'useless';
        return;
      }
      const practice = chosen === usual.vocabulary.domain ? usual : await practiceOf(chosen);
      this.#examples = this.#isFirst ? workedExamples(practice) : [];
      this.demonstrations = this.#isFirst ? firstDemonstrations(practice, outlook) : [];
      const queries = this.#isFirst ? firstQueries(practice, outlook) : practice.queries;
      this.#practice = { ...practice, queries };
      if (!this.#isFirst) this.phase = 'intro';
      else if (this.total === 0) this.phase = 'useless';
      else this.start();
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

  /** After a worked example, ask the question. */
  begin(): void {
    this.example = null;
    this.phase = 'question';
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
    if (this.phase === 'demonstration') this.demonstrations = this.demonstrations.slice(1);
    if (this.phase !== 'demonstration' && this.place + 1 < this.total) this.#show(this.place + 1);
    else this.phase = this.demonstrations.length > 0 ? 'demonstration' : 'done';
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
    this.example = this.#exampleFor(this.query?.ask.kind);
    this.phase = this.example === null ? 'question' : 'example';
  }

  /** Return the worked example of a kind, if this is the first practice and its first question of the kind. */
  #exampleFor(kind: AnswerableKind | undefined): WorkedExample | null {
    const found = this.#examples.find(({ ask }) => ask.kind === kind) ?? null;
    this.#examples = this.#examples.filter((example) => example !== found);
    return found;
  }

  /** Return the queries of the practice. A demonstration needs a learner’s environment, so it is only looked at. */
  #queries(): readonly PracticeQuery[] {
    const queries = this.#practice?.queries ?? [];
    return queries.flatMap(({ id, ask }) => (ask.kind === 'hier_demo' ? [] : [{ id, ask }]));
  }
}

function practiceOf(domain?: string): Promise<Practice> {
  return unwrap(api.GET('/api/v1/practice', { params: { query: domain === undefined ? {} : { domain } } }));
}

function workedExamples(practice: Practice): WorkedExample[] {
  return practice.examples.flatMap(({ query, feedback }) => {
    const ask = practice.queries.find(({ id }) => id === query)?.ask;
    return ask === undefined || ask.kind === 'hier_demo' ? [] : [{ ask, feedback }];
  });
}
