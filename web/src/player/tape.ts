// The tape: the trajectory of a query as frames, one per state.
import type { Box, Json, Segment } from '../api/types';
import { t } from '../language/language';
import type { Player } from './player';

/** Boxes in a picture, by the name of the subgoal or action. */
export type Boxes = Readonly<Record<string, Box>>;

/** Where subgoals are in a picture, and where actions lead. */
export interface Landmarks {
  readonly subgoals: Boxes;
  readonly actions: Boxes;
}

/** The landmarks of several states as a message has them. */
export type SentLandmarks = Partial<Pick<Segment, 'landmarks' | 'action_landmarks'>>;

export const NO_LANDMARKS: Landmarks = { subgoals: {}, actions: {} };

/** A segment on the tape: the frames from `first` to `last`, both included. */
export interface Stretch {
  readonly index: number;
  readonly subgoal: string | null;
  readonly first: number;
  readonly last: number;
  readonly actions: readonly string[];
  /** Whether the query asks about this segment. Earlier segments are only shown. */
  readonly asked: boolean;
  /** Whether the learner failed here, and somebody else plays on. */
  readonly failed?: true;
}

/** The joined segments of a query. The last state of a segment and the first of the next are one frame. */
export interface Tape {
  readonly frames: readonly Json[];
  /** The hash of each frame's picture; null if the learner sent none. */
  readonly pictures: readonly (string | null)[];
  /** The landmarks in each frame's picture; none if the learner sent none. */
  readonly landmarks: readonly Landmarks[];
  readonly stretches: readonly Stretch[];
  /** The frame where the first segment begins that the query asks about. */
  readonly start: number;
  /** Whether the trajectory goes on after the last frame, as in a demonstration that is being played. */
  readonly goesOn: boolean;
}

/** A tape in a player. */
export interface Playable {
  readonly tape: Tape;
  readonly player: Player;
  readonly pace: number; // milliseconds per frame while it plays
  tick(frames: number): void;
  seek(frame: number): void;
}

/** Return the tape of segments. `failed`: the last one of the context failed. */
export function buildTape(context: readonly Segment[], asked: readonly Segment[], failed = false): Tape {
  const frames: Json[] = [];
  const pictures: (string | null)[] = [];
  const landmarks: Landmarks[] = [];
  const stretches = [...context, ...asked].map((segment, index): Stretch => {
    const joined = frames.length > 0 && same(frames.at(-1), segment.states[0]);
    const skipped = joined ? 1 : 0;
    frames.push(...segment.states.slice(skipped));
    pictures.push(...segment.states.map((_, state) => segment.frames[state] ?? null).slice(skipped));
    landmarks.push(...segment.states.map((_, state) => landmarksAt(segment, state)).slice(skipped));
    const last = frames.length - 1;
    const first = last - segment.states.length + 1;
    return {
      index,
      subgoal: segment.subgoal,
      first,
      last,
      actions: segment.actions,
      asked: index >= context.length,
      ...(failed && index === context.length - 1 ? { failed } : {}),
    };
  });
  const start = stretches[context.length]?.first ?? 0;
  return { frames, pictures, landmarks, stretches, start, goesOn: false };
}

/** Return the landmarks of a state. The learner sends an entry for each state, one for all states, or none. */
export function landmarksAt(sent: SentLandmarks, state: number): Landmarks {
  const boxesAt = (boxes: readonly Boxes[] = []): Boxes => boxes[boxes.length === 1 ? 0 : state] ?? {};
  return { subgoals: boxesAt(sent.landmarks), actions: boxesAt(sent.action_landmarks) };
}

/** Return the landmarks of states as a message has them. */
export function sentLandmarks(states: readonly Landmarks[]): Required<SentLandmarks> {
  const sent = (boxes: Boxes[]): Boxes[] => (boxes.some((one) => Object.keys(one).length > 0) ? boxes : []);
  return {
    landmarks: sent(states.map((one) => one.subgoals)),
    action_landmarks: sent(states.map((one) => one.actions)),
  };
}

export function lastFrame(tape: Tape): number {
  return Math.max(0, tape.frames.length - 1);
}

/** Return the stretch of a frame. A frame shared by two stretches belongs to the second. */
export function stretchAt(tape: Tape, frame: number): Stretch | undefined {
  const within = tape.stretches.filter((stretch) => stretch.first <= frame && frame <= stretch.last);
  return within.at(-1);
}

/** Return the action taken at a frame, or null at the end. */
export function actionAt(tape: Tape, frame: number): string | null {
  const stretch = stretchAt(tape, frame);
  return stretch?.actions[frame - stretch.first] ?? null;
}

/** Return the frames of the states that the query asks about: the states with an action, then the last state. */
export function askedFrames(tape: Tape): number[] {
  const acting = tape.stretches
    .filter((stretch) => stretch.asked)
    .flatMap((stretch) => stretch.actions.map((_, step) => stretch.first + step));
  return [...acting, lastFrame(tape)];
}

/** Return the frames where a subgoal was chosen, and the last frame. The keys `[` and `]` jump between them. */
export function stops(tape: Tape): number[] {
  const all = [...tape.stretches.map((stretch) => stretch.first), lastFrame(tape)];
  return [...new Set(all)].sort((a, b) => a - b);
}

/** Return a frame in words: "step 12 of 40, action left, subgoal north". */
export function describeFrame(tape: Tape, frame: number): string {
  const parts = [t(`step ${frame} of ${lastFrame(tape)}`)];
  const action = actionAt(tape, frame);
  if (action !== null) parts.push(t(`action ${action}`));
  const subgoal = stretchAt(tape, frame)?.subgoal;
  if (subgoal) parts.push(t(`subgoal ${subgoal}`));
  return parts.join(', ');
}

function same(a: Json, b: Json): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}
