// A demonstration that is being played, as a list of moves. Pure: no function changes its arguments.
import type { AnswerOf, AskOf, DemoSegment, Json, PlayStates, Price } from '../api/types';
import { t } from '../language/language';
import {
  buildTape,
  landmarksAt,
  lastFrame,
  NO_LANDMARKS,
  sentLandmarks,
  type Landmarks,
  type Stretch,
  type Tape,
} from '../player/tape';
import { count } from '../ui/format';

/** A move of the annotator. A demonstration is a list of moves, so that each can be undone, including starting over. */
export type Move =
  | { readonly does: 'choose'; readonly subgoal: string }
  | { readonly does: 'act'; readonly action: string }
  | { readonly does: 'reach' }
  | { readonly does: 'restart' };

/** A demonstration so far. */
export interface Demonstration {
  readonly moves: readonly Move[];
  readonly states: readonly Json[]; // s_1 and the states that the learner's environment has returned
  readonly pictures: readonly (string | null)[]; // the hash of each state's picture; null if there is none yet
  readonly landmarks: readonly Landmarks[]; // in each state's picture
  readonly ended: boolean; // whether the episode ended in the last of these states
  readonly succeeded: boolean; // whether the task is accomplished in the last of these states
}

/** A segment so far. */
export interface Part {
  readonly subgoal: string | null; // null in a flat demonstration
  readonly actions: readonly string[];
  readonly reached: boolean; // whether the annotator said that the subgoal is reached
}

type Ask = AskOf<'hier_demo'>;

/** Return whether the demonstration begins where the learner failed. */
export function playsOn(ask: Ask): boolean {
  return ask.context.length > 0;
}

export function begin(ask: Ask, moves: readonly Move[] = []): Demonstration {
  return {
    moves,
    states: [ask.state],
    pictures: [null],
    landmarks: [NO_LANDMARKS],
    ended: false,
    succeeded: false,
  };
}

/** Return the segments since the last start. */
export function partsOf({ moves }: Demonstration): Part[] {
  const parts: Part[] = [];
  for (const move of moves.slice(moves.findLastIndex((one) => one.does === 'restart') + 1)) {
    const last = parts.at(-1);
    if (move.does === 'choose') {
      if (last?.actions.length === 0) parts.pop(); // another choice before the first step
      parts.push({ subgoal: move.subgoal, actions: [], reached: false });
    } else if (move.does === 'act') {
      const under = last?.reached === false ? last : { subgoal: null, actions: [], reached: false };
      if (under === last) parts.pop();
      parts.push({ ...under, actions: [...under.actions, move.action] });
    } else if (move.does === 'reach' && last) {
      parts.splice(-1, 1, { ...last, reached: true });
    }
  }
  return parts;
}

export function segmentsOf(demonstration: Demonstration): DemoSegment[] {
  const parts = partsOf(demonstration).filter((part) => part.actions.length > 0);
  return parts.map(({ subgoal, actions }) => ({ subgoal, actions: [...actions] }));
}

export function countActions(parts: readonly Part[]): number {
  return parts.reduce((sum, part) => sum + part.actions.length, 0);
}

/** Return the actions whose states are not known yet. */
export function pendingOf(demonstration: Demonstration): string[] {
  return partsOf(demonstration)
    .flatMap((part) => part.actions)
    .slice(demonstration.states.length - 1);
}

/** Return whether there are all the segments that the query allows, and the last one is reached. */
export function isComplete(demonstration: Demonstration, ask: Ask): boolean {
  const parts = partsOf(demonstration);
  return !ask.flat && parts.length >= ask.max_segments && parts.at(-1)?.reached === true;
}

/** Return whether the states of some actions have not arrived yet. */
export function isBehind(demonstration: Demonstration): boolean {
  return countActions(partsOf(demonstration)) >= demonstration.states.length && !demonstration.ended;
}

/** Return why a move cannot be made now, or null if it can. */
export function obstacle(demonstration: Demonstration, ask: Ask, move: Move): string | null {
  const parts = partsOf(demonstration);
  const under = parts.at(-1);
  const isUnderWay = under !== undefined && !under.reached;
  if (move.does === 'restart') return parts.length === 0 ? t('No step is played yet.') : null;
  if (demonstration.ended)
    return t('The episode is over. Send the demonstration, undo a step, or start over.');
  switch (move.does) {
    case 'choose':
      if (isUnderWay && under.actions.length > 0) return t('First press “Reached” for the last subgoal.');
      if (!isUnderWay && parts.length >= ask.max_segments)
        return count(ask.max_segments, [
          'A demonstration has at most # segment.',
          'A demonstration has at most # segments.',
        ]);
      return null;
    case 'act':
      if (!ask.flat && !isUnderWay) return t('Choose a subgoal first.');
      if (countActions(parts) >= ask.max_actions)
        return count(ask.max_actions, [
          'A demonstration has at most # step.',
          'A demonstration has at most # steps.',
        ]);
      return null;
    case 'reach':
      if (!isUnderWay) return t('Choose the next subgoal, or send the demonstration.');
      return under.actions.length === 0 ? t('A segment has at least one step.') : null;
  }
}

export function make(demonstration: Demonstration, move: Move): Demonstration {
  return fitted({ ...demonstration, moves: [...demonstration.moves, move] });
}

/** Undo the last move. */
export function takeBack(demonstration: Demonstration): Demonstration {
  return fitted({ ...demonstration, moves: demonstration.moves.slice(0, -1) });
}

/** Add the states that the environment returned. Moves after the end of the episode are dropped. */
export function learn(demonstration: Demonstration, news: PlayStates): Demonstration {
  const states = [...demonstration.states.slice(0, news.known), ...news.states];
  const pictures = states.map((_, at) => news.frames[at - news.known] ?? demonstration.pictures[at] ?? null);
  const landmarks = states.map((_, at) =>
    at < news.known ? (demonstration.landmarks[at] ?? NO_LANDMARKS) : landmarksAt(news, at - news.known),
  );
  const { ended, succeeded } = news;
  const moves = ended ? upTo(demonstration.moves, states.length - 1) : demonstration.moves;
  return { moves, states, pictures, landmarks, ended, succeeded };
}

/** Return what the demonstration costs as an answer, in units, at the server's price. */
export function costOf(demonstration: Demonstration, price: Price): number {
  const segments = segmentsOf(demonstration);
  const actions = segments.reduce((sum, segment) => sum + segment.actions.length, 0);
  const hierarchical = segments.filter((segment) => segment.subgoal !== null).length;
  return price.fixed + price.per_action * actions + price.per_segment * hierarchical;
}

/** Return the answer, with what was seen if `withReplay`; null if there is no step, or if a step has no state yet. */
export function answerOf(demonstration: Demonstration, withReplay: boolean): AnswerOf<'hier_demo'> | null {
  const segments = segmentsOf(demonstration);
  if (segments.length === 0 || isBehind(demonstration)) return null;
  const { states, pictures, landmarks } = demonstration;
  const frames = pictures.filter((picture) => picture !== null);
  const replay = {
    states: [...states],
    frames: frames.length === states.length ? frames : [],
    ...sentLandmarks(landmarks),
  };
  return { kind: 'hier_demo', segments, replay: withReplay ? replay : null };
}

/** Return what the learner did before, and the demonstration as far as its states are known, as one tape. */
export function tapeOf(demonstration: Demonstration, { context }: Ask): Tape {
  const before = buildTape(context, [], true);
  const start = lastFrame(before); // where the demonstration begins
  const end = start + demonstration.states.length - 1;
  let next = start;
  const stretches = partsOf(demonstration).map(({ subgoal, actions }, place): Stretch => {
    const first = Math.min(next, end);
    const last = Math.min(next + actions.length, end);
    next += actions.length;
    const index = context.length + place;
    return { index, subgoal, first, last, actions: actions.slice(0, last - first), asked: true };
  });
  const { states, pictures, landmarks, ended } = demonstration;
  const [here] = pictures; // of the first state, which the learner's environment shows as soon as it is here
  return {
    frames: [...before.frames.slice(0, start), ...states],
    pictures: [
      ...before.pictures.slice(0, start),
      here ?? before.pictures[start] ?? null,
      ...pictures.slice(1),
    ],
    landmarks: [...before.landmarks.slice(0, start), ...landmarks],
    stretches: [...before.stretches, ...stretches],
    start,
    goesOn: !ended,
  };
}

/** Return the demonstration without the states of undone actions. */
function fitted(demonstration: Demonstration): Demonstration {
  const most = countActions(partsOf(demonstration)) + 1;
  if (most >= demonstration.states.length) return demonstration;
  return {
    ...demonstration,
    states: demonstration.states.slice(0, most),
    pictures: demonstration.pictures.slice(0, most),
    landmarks: demonstration.landmarks.slice(0, most),
    ended: false,
    succeeded: false,
  };
}

/** Return the moves up to a number of actions since the last start. */
function upTo(moves: readonly Move[], actions: number): readonly Move[] {
  let left = actions;
  const start = moves.findLastIndex((one) => one.does === 'restart') + 1;
  const first = moves.findIndex((one, place) => place >= start && one.does === 'act' && left-- === 0);
  return first === -1 ? moves : moves.slice(0, first);
}
