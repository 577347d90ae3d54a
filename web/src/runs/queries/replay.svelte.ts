// The replay of a query: its trajectory in the player, with the labels of its answer.
import type { Answer, AnswerOf, Json, Query, Run, Segment } from '../../api/types';
import type { Command } from '../../keys/registry';
import { MOVES } from '../../player/commands';
import * as players from '../../player/player';
import {
  askedFrames,
  buildTape,
  landmarksAt,
  lastFrame,
  sentLandmarks,
  stops,
  stretchAt,
  type Tape,
} from '../../player/tape';
import type { Label, Scene, Step } from '../../player/scene';

const NONE = sentLandmarks([]);

/** A query in the player. It can only be watched. */
export class Replay {
  readonly tape: Tape;
  player = $state.raw(players.player(0, 0));
  readonly scene: Scene = $derived.by(() => this.#scene());

  readonly #query: Query;
  readonly #run: Run;
  readonly #stops: readonly number[];
  readonly #labels: readonly Label[];

  /** `step` computes the next state; null if the web app cannot compute the steps of this domain. */
  constructor(query: Query, run: Run, step: Step | null) {
    this.#query = query;
    this.#run = run;
    this.tape = tapeOf(query, step);
    this.#stops = stops(this.tape);
    this.#labels = labelsOf(query.answer, this.tape);
    const begin = players.player(this.tape.start, lastFrame(this.tape));
    this.player = players.seek(begin, begin.last);
  }

  /** Milliseconds per frame while playing. */
  get pace(): number {
    return 1000 / players.framesPerSecond(this.player, false);
  }

  tick(frames: number): void {
    this.player = players.advance(this.player, frames);
  }

  seek(frame: number): void {
    this.player = players.seek(this.player, frame);
  }

  run(command: Command): void {
    const move = MOVES[command];
    if (move) this.player = move(this.player, this.#stops);
  }

  #scene(): Scene {
    return {
      instance: this.#query.ask.instance,
      tape: this.tape,
      vocabulary: this.#run.vocabulary,
      at: this.player.at,
      current: stretchAt(this.tape, this.player.at)?.index ?? null,
      labels: this.#labels,
    };
  }
}

/** Return the learner's trajectory; for a demonstration, the annotator's, as far as its states are known. */
export function tapeOf({ ask, answer }: Pick<Query, 'ask' | 'answer'>, step: Step | null): Tape {
  if (ask.kind !== 'hier_demo') return buildTape(ask.context, ask.segments);
  const start: Segment = { subgoal: null, states: [ask.state], actions: [], frames: [], ...NONE };
  const demonstrated = answer?.kind === 'hier_demo' ? segmentsOf(ask.state, answer, step) : null;
  if (demonstrated !== null) return buildTape(ask.context, demonstrated, true);
  return { ...buildTape(ask.context, [start], true), goesOn: true };
}

/** Return the segments of a demonstration with their states: computed, or else as the annotator saw them. */
function segmentsOf(first: Json, answer: AnswerOf<'hier_demo'>, step: Step | null): Segment[] | null {
  const { segments, replay } = answer;
  if (step === null && !replay?.states.length) return null;
  let state = first;
  let before = 0; // steps before the segment
  return segments.map(({ subgoal, actions }): Segment => {
    const [begin, end] = [before, (before += actions.length) + 1];
    if (step === null) {
      const states = replay?.states.slice(begin, end) ?? [];
      const landmarks = states.map((_, at) => landmarksAt(replay ?? {}, begin + at));
      const frames = replay?.frames?.slice(begin, end) ?? [];
      return { subgoal, states, actions, frames, ...sentLandmarks(landmarks) };
    }
    const states = [state, ...actions.map((action) => (state = step(state, action)))];
    return { subgoal, states, actions, frames: [], ...NONE };
  });
}

/** Return the labels of the answer, as a renderer draws them. */
export function labelsOf(answer: Answer | null, tape: Tape): Label[] {
  if (answer === null || (answer.kind !== 'label_lo' && answer.kind !== 'label_full')) return [];
  const frames = askedFrames(tape);
  const end = answer.kind === 'label_lo' ? answer.terminations.indexOf(true) : -1;
  const until = end < 0 ? answer.actions.length : end;
  const labels = answer.actions
    .slice(0, until)
    .flatMap((action, state) => (action === null ? [] : [{ frame: frames[state] ?? 0, name: action }]));
  return end < 0 ? labels : [...labels, { frame: frames[end] ?? 0, name: null }];
}
