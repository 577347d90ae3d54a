import type { Answer, Ask, Query, Run } from '../api/types';
import type { Command } from '../keys/registry';
import { MOVES } from '../player/commands';
import * as players from '../player/player';
import { askedFrames, buildTape, lastFrame, stops, stretchAt, type Tape } from '../player/tape';
import type { Label, Scene } from '../render/scene';

/** A query's trajectory in the player, with its answer marked: only to be watched. */
export class Replay {
  readonly tape: Tape;
  player = $state.raw(players.player(0, 0));
  readonly scene: Scene = $derived.by(() => this.#scene());

  readonly #query: Query;
  readonly #run: Run;
  readonly #stops: readonly number[];
  readonly #labels: readonly Label[];

  constructor(query: Query, run: Run) {
    this.#query = query;
    this.#run = run;
    this.tape = tapeOf(query.ask);
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

/** A demonstration has no trajectory of the learner's: only where it starts. */
export function tapeOf(ask: Ask): Tape {
  if (ask.kind !== 'hier_demo') return buildTape(ask.context, ask.segments);
  return buildTape(ask.context, [{ subgoal: null, states: [ask.state], actions: [], frames: [] }]);
}

/** What the expert said about each state, as marks on the picture. */
export function labelsOf(answer: Answer | null, tape: Tape): Label[] {
  if (answer === null || (answer.kind !== 'label_lo' && answer.kind !== 'label_full')) return [];
  const frames = askedFrames(tape);
  const end = answer.kind === 'label_lo' ? answer.terminations.indexOf(true) : -1;
  const until = end < 0 ? answer.actions.length : end;
  const labels = answer.actions
    .slice(0, until)
    .flatMap((action, state) => (action === null ? [] : [{ frame: frames[state] ?? 0, action }]));
  return end < 0 ? labels : [...labels, { frame: frames[end] ?? 0, action: null }];
}
