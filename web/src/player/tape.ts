import type { Json, Segment } from '../api/types';
import type { Player } from './player';

/** One segment on the tape: frames `first` to `last`, both included. */
export interface Stretch {
  readonly index: number;
  readonly subgoal: string | null;
  readonly first: number;
  readonly last: number;
  readonly actions: readonly string[];
  /** False for the segments that came before, shown but not asked about. */
  readonly asked: boolean;
}

/** A query's segments, joined: where one ends the next begins, so the state between them is one frame. */
export interface Tape {
  readonly frames: readonly Json[];
  /** The hash of a picture of each frame, where the learner sent one. */
  readonly pictures: readonly (string | null)[];
  readonly stretches: readonly Stretch[];
  /** The frame where the asked segments begin. */
  readonly start: number;
}

/** A tape in a player. */
export interface Playable {
  readonly tape: Tape;
  readonly player: Player;
  seek(frame: number): void;
}

export function buildTape(context: readonly Segment[], asked: readonly Segment[]): Tape {
  const frames: Json[] = [];
  const pictures: (string | null)[] = [];
  const stretches = [...context, ...asked].map((segment, index): Stretch => {
    const joined = frames.length > 0 && same(frames.at(-1), segment.states[0]);
    const skipped = joined ? 1 : 0;
    frames.push(...segment.states.slice(skipped));
    pictures.push(...segment.states.map((_, state) => segment.frames[state] ?? null).slice(skipped));
    const last = frames.length - 1;
    const first = last - segment.states.length + 1;
    return {
      index,
      subgoal: segment.subgoal,
      first,
      last,
      actions: segment.actions,
      asked: index >= context.length,
    };
  });
  return { frames, pictures, stretches, start: stretches[context.length]?.first ?? 0 };
}

export function lastFrame(tape: Tape): number {
  return Math.max(0, tape.frames.length - 1);
}

/** The stretch a frame belongs to; a frame between two belongs to the one that begins there. */
export function stretchAt(tape: Tape, frame: number): Stretch | undefined {
  const within = tape.stretches.filter((stretch) => stretch.first <= frame && frame <= stretch.last);
  return within.at(-1);
}

/** The action that leads away from a frame, or null at the end. */
export function actionAt(tape: Tape, frame: number): string | null {
  const stretch = stretchAt(tape, frame);
  return stretch?.actions[frame - stretch.first] ?? null;
}

/** The frames of the asked states, in order: every state an action was taken in, then the last one. */
export function askedFrames(tape: Tape): number[] {
  const acting = tape.stretches
    .filter((stretch) => stretch.asked)
    .flatMap((stretch) => stretch.actions.map((_, step) => stretch.first + step));
  return [...acting, lastFrame(tape)];
}

/** Frames where a subgoal was decided, and the last frame: what `[` and `]` jump between. */
export function stops(tape: Tape): number[] {
  const all = [...tape.stretches.map((stretch) => stretch.first), lastFrame(tape)];
  return [...new Set(all)].sort((a, b) => a - b);
}

/** "step 12 of 40, action left, subgoal north" */
export function describeFrame(tape: Tape, frame: number): string {
  const parts = [`step ${frame} of ${lastFrame(tape)}`];
  const action = actionAt(tape, frame);
  if (action !== null) parts.push(`action ${action}`);
  const subgoal = stretchAt(tape, frame)?.subgoal;
  if (subgoal) parts.push(`subgoal ${subgoal}`);
  return parts.join(', ');
}

function same(a: Json, b: Json): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}
