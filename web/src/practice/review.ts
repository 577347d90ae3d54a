// The feedback in words, and the places on the map that it is about.
import { labelWords } from '../api/names';
import type { Answerable, Feedback } from '../api/types';
import { t } from '../language/language';
import { askedFrames, lastFrame, type Tape } from '../player/tape';
import { either } from '../ui/format';

export type Mark = Feedback['marks'][number];

/** Return the frame that a label is about. */
export function frameOf(ask: Answerable, tape: Tape, mark: Mark): number {
  if (ask.kind === 'inspect_full' || ask.kind === 'inspect_lo') return lastFrame(tape);
  if (ask.kind !== 'label_hi') return askedFrames(tape)[mark.place] ?? lastFrame(tape);
  return tape.stretches[ask.context.length + mark.place]?.first ?? tape.start;
}

/** Return what a label is about: "Segment 2", "State 5". */
export function placeOf(ask: Answerable, mark: Mark): string {
  if (ask.kind === 'inspect_full' || ask.kind === 'inspect_lo') return t('Answer');
  return ask.kind === 'label_hi' ? t(`Segment ${mark.place + 1}`) : t(`State ${mark.place + 1}`);
}

/**
 * Return the learner's own label if it is a mistake, for an answer that corrects it; else null. An inspection labels
 * nothing that the learner chose.
 */
export function mistakeOf(ask: Answerable, { place, right }: Mark): string | null {
  const own = ownLabel(ask, place);
  return own === null || right.includes(own) ? null : own;
}

function ownLabel(ask: Answerable, place: number): string | null {
  if (ask.kind === 'inspect_full' || ask.kind === 'inspect_lo') return null;
  if (ask.kind === 'label_hi') return ask.segments[place]?.subgoal ?? null;
  const action = ask.segments.flatMap((segment) => segment.actions)[place];
  if (ask.kind === 'label_full' || action !== undefined) return action ?? null;
  const { suggestion } = ask;
  return suggestion && 'terminations' in suggestion && suggestion.terminations.at(-1) ? '(done)' : null;
}

export function choicesWords(right: readonly string[]): string {
  return either(right.map(labelWords));
}

/** Return the index of the first label that is wrong or corrects the learner; 0 if there is none. */
export function firstToSee(ask: Answerable, marks: readonly Mark[]): number {
  const wrong = marks.findIndex((mark) => !mark.is_right);
  return Math.max(0, wrong >= 0 ? wrong : marks.findIndex((mark) => mistakeOf(ask, mark) !== null));
}

/** Return the result in words: "Right", "2 of 5 right". */
export function verdictWords(marks: readonly Mark[]): string {
  const right = marks.filter((mark) => mark.is_right).length;
  if (right === marks.length) return t('Right');
  return marks.length === 1 ? t('Not right') : t(`${right} of ${marks.length} right`);
}
