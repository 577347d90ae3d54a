// The editor of Label_HI: one subgoal per segment. Pure: every function returns the next state.
import type { AnswerOf, AskOf } from '../../api/types';

export interface HiLabels {
  readonly kind: 'label_hi';
  readonly suggested: readonly (string | null)[]; // the learner's own choices
  readonly subgoals: readonly (string | null)[]; // null: not labeled yet
  readonly cursor: number;
  readonly past: readonly Snapshot[];
}

type Snapshot = Pick<HiLabels, 'subgoals' | 'cursor'>;

export function hiLabels(ask: AskOf<'label_hi'>): HiLabels {
  const suggestion = ask.suggestion?.kind === 'label_hi' ? ask.suggestion.subgoals : null;
  const suggested = ask.segments.map((segment, index) => suggestion?.[index] ?? segment.subgoal);
  return { kind: 'label_hi', suggested, subgoals: suggested.map(() => null), cursor: 0, past: [] };
}

/** Label the current segment and move to the next. */
export function setSubgoal(labels: HiLabels, subgoal: string): HiLabels {
  return edit(labels, labels.subgoals.with(labels.cursor, subgoal), labels.cursor + 1);
}

/** Label several segments in one edit, and move to the first segment without a label. */
export function setSubgoals(labels: HiLabels, chosen: ReadonlyMap<number, string>): HiLabels {
  if (chosen.size === 0) return labels;
  const subgoals = labels.subgoals.map((subgoal, index) => chosen.get(index) ?? subgoal);
  const open = subgoals.indexOf(null);
  return edit(labels, subgoals, open === -1 ? Math.max(...chosen.keys()) : open);
}

/** Keep the label of the current segment, else take the learner's choice, and move to the next segment. */
export function acceptSubgoal(labels: HiLabels): HiLabels {
  const subgoal = labels.subgoals[labels.cursor] ?? labels.suggested[labels.cursor];
  if (subgoal === null || subgoal === undefined) return labels;
  const next = setSubgoal(labels, subgoal);
  const behind = labels.cursor === labels.subgoals.length - 1 ? next.subgoals.indexOf(null) : -1;
  return behind === -1 ? next : { ...next, cursor: behind };
}

export function acceptRemaining(labels: HiLabels): HiLabels {
  const subgoals = labels.subgoals.map((subgoal, index) => subgoal ?? labels.suggested[index] ?? null);
  return edit(labels, subgoals, labels.cursor);
}

export function moveTo(labels: HiLabels, index: number): HiLabels {
  return { ...labels, cursor: bounded(labels, index) };
}

/** Undo the last edit. */
export function clearLast(labels: HiLabels): HiLabels {
  const snapshot = labels.past.at(-1);
  return snapshot ? { ...labels, ...snapshot, past: labels.past.slice(0, -1) } : labels;
}

/** Return the answer, or null while a segment is not labeled. */
export function hiAnswer(labels: HiLabels): AnswerOf<'label_hi'> | null {
  const subgoals = labels.subgoals.filter((subgoal) => subgoal !== null);
  return subgoals.length === labels.subgoals.length ? { kind: 'label_hi', subgoals } : null;
}

function edit(labels: HiLabels, subgoals: HiLabels['subgoals'], cursor: number): HiLabels {
  const past = [...labels.past, { subgoals: labels.subgoals, cursor: labels.cursor }];
  return { ...labels, subgoals, cursor: bounded(labels, cursor), past };
}

function bounded(labels: HiLabels, index: number): number {
  return Math.min(Math.max(index, 0), labels.subgoals.length - 1);
}
