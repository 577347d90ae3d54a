// The editor of Label_LO and Label_FULL: an action per state. Pure: every function returns the next state.
import type { AnswerOf, AskOf } from '../../api/types';

/**
 * The labels so far: an action at each state and, in Label_LO, the state where the segment should have ended. A segment
 * of H actions has states 0 to H; the last state has no action.
 */
export interface LoLabels {
  readonly kind: 'label_lo' | 'label_full';
  readonly suggested: Choice; // the learner's own actions and end
  readonly actions: readonly (string | null)[]; // null: not labeled yet
  readonly end: End;
  readonly cursor: number;
  readonly past: readonly Snapshot[];
}

/** The state where the segment should have ended; 'never': at none of its states; null: not labeled yet. Label_LO only. */
type End = number | 'never' | null;
interface Choice {
  readonly actions: readonly string[];
  readonly end: End;
}
type Snapshot = Pick<LoLabels, 'actions' | 'end' | 'cursor'>;

export function loLabels(ask: AskOf<'label_lo' | 'label_full'>): LoLabels {
  const own = ask.segments.flatMap((segment) => segment.actions);
  const suggestion = ask.suggestion?.kind === ask.kind ? ask.suggestion : null;
  const suggested = {
    actions: own.map((action, index) => suggestion?.actions[index] ?? action),
    end: ask.kind === 'label_full' ? null : suggestedEnd(suggestion, own.length),
  };
  return { kind: ask.kind, suggested, actions: own.map(() => null), end: null, cursor: 0, past: [] };
}

function suggestedEnd(suggestion: AnswerOf<'label_lo' | 'label_full'> | null, length: number): End {
  if (suggestion?.kind !== 'label_lo') return length; // the learner ended the segment at its last state
  const end = suggestion.terminations.indexOf(true);
  return end === -1 ? 'never' : end;
}

/** Return the last state that needs a label. */
export function lastState(labels: LoLabels): number {
  return labels.kind === 'label_lo' ? labels.actions.length : Math.max(0, labels.actions.length - 1);
}

/** Return the first state whose label is missing, or null if no label is missing. */
export function firstOpen(labels: LoLabels): number | null {
  const until = typeof labels.end === 'number' ? labels.end : labels.actions.length;
  const open = labels.actions.findIndex((action, state) => action === null && state < until);
  if (open !== -1) return open;
  return labels.kind === 'label_lo' && labels.end === null ? labels.actions.length : null;
}

/** Return whether a state needs no label because the segment should have ended before it. */
export function isPast(labels: LoLabels, state: number): boolean {
  return typeof labels.end === 'number' && state > labels.end;
}

/** Label the current state with an action and move to the next. The segment then does not end here. */
export function setAction(labels: LoLabels, action: string): LoLabels {
  const { cursor } = labels;
  if (cursor >= labels.actions.length) return labels;
  const end = typeof labels.end === 'number' && cursor >= labels.end ? null : labels.end;
  return edit(labels, { actions: labels.actions.with(cursor, action), end, cursor: cursor + 1 });
}

/** Label several states in one edit, and move to the state `next`; if it is null, to the first state without a label. */
export function setActions(
  labels: LoLabels,
  chosen: ReadonlyMap<number, string>,
  next: number | null,
): LoLabels {
  if (chosen.size === 0) return labels;
  const actions = labels.actions.map((action, state) => chosen.get(state) ?? action);
  const end = typeof labels.end === 'number' && Math.max(...chosen.keys()) >= labels.end ? null : labels.end;
  const edited = edit(labels, { actions, end, cursor: labels.cursor });
  return moveTo(edited, next ?? firstOpen(edited) ?? Math.max(...chosen.keys()));
}

/** Done here: the segment should have ended at the current state; later states need no label. */
export function setDone(labels: LoLabels): LoLabels {
  if (labels.kind !== 'label_lo') return labels;
  const actions = labels.actions.map((action, state) => (state < labels.cursor ? action : null));
  return edit(labels, { actions, end: labels.cursor, cursor: labels.cursor });
}

/** Not done: the segment should not have ended, even at its last state. */
export function setNotDone(labels: LoLabels): LoLabels {
  const { actions, cursor } = labels;
  if (labels.kind !== 'label_lo' || cursor < actions.length) return labels;
  return edit(labels, { actions, end: 'never', cursor });
}

/** Keep the label of the current state, else take the learner's choice, and move to the next state. */
export function acceptState(labels: LoLabels): LoLabels {
  const { cursor, suggested } = labels;
  if (!isOpen(labels, cursor)) return moveTo(labels, onward(labels));
  if (suggested.end === cursor) return setDone(labels);
  if (cursor === labels.actions.length) return suggested.end === 'never' ? setNotDone(labels) : labels;
  const action = suggested.actions[cursor];
  return action === undefined ? labels : setAction(labels, action);
}

/** The first wrong step is here: everything before it is right. */
export function markFirstWrong(labels: LoLabels, state: number): LoLabels {
  const cursor = bounded(labels, state);
  const actions = labels.actions.map((action, index) => {
    if (index >= cursor) return index === cursor ? null : action;
    return action ?? labels.suggested.actions[index] ?? null;
  });
  const end = typeof labels.end === 'number' && labels.end <= cursor ? null : labels.end;
  return edit(labels, { actions, end, cursor });
}

/** Move to a state that was pointed at. If it is after the first unlabeled one, the first wrong step is here. */
export function pickState(labels: LoLabels, state: number): LoLabels {
  const open = labels.actions.indexOf(null);
  const isLater = open !== -1 && state > open && state < labels.actions.length;
  return isLater ? markFirstWrong(labels, state) : moveTo(labels, state);
}

/** Take the learner's choice at every state without a label. */
export function acceptRest(labels: LoLabels): LoLabels {
  const { suggested } = labels;
  const mayEnd = typeof suggested.end !== 'number' || (labels.actions[suggested.end] ?? null) === null;
  const end = labels.end ?? (mayEnd ? suggested.end : null);
  const until = typeof end === 'number' ? end : labels.actions.length;
  const actions = labels.actions.map((action, state) =>
    state < until ? (action ?? suggested.actions[state] ?? null) : null,
  );
  const next = edit(labels, { actions, end, cursor: labels.cursor });
  return { ...next, cursor: firstOpen(next) ?? labels.cursor };
}

export function moveTo(labels: LoLabels, state: number): LoLabels {
  return { ...labels, cursor: bounded(labels, state) };
}

/** Undo the last edit. */
export function clearLast(labels: LoLabels): LoLabels {
  const snapshot = labels.past.at(-1);
  return snapshot ? { ...labels, ...snapshot, past: labels.past.slice(0, -1) } : labels;
}

/** Return the answer, or null while a label is missing. */
export function loAnswer(labels: LoLabels): AnswerOf<'label_lo' | 'label_full'> | null {
  if (firstOpen(labels) !== null) return null;
  const { actions, end } = labels;
  if (labels.kind === 'label_full') {
    return { kind: 'label_full', actions: actions.filter((action) => action !== null) };
  }
  const terminations = [...actions, null].map((_, state) => state === end);
  return { kind: 'label_lo', actions: [...actions], terminations };
}

function isOpen(labels: LoLabels, state: number): boolean {
  if (
    labels.end !== null &&
    (labels.end === 'never' ? state === labels.actions.length : state >= labels.end)
  ) {
    return false;
  }
  return state === labels.actions.length || labels.actions[state] === null;
}

function onward(labels: LoLabels): number {
  const { cursor } = labels;
  const atEnd = cursor === lastState(labels) || cursor === labels.end;
  return atEnd ? (firstOpen(labels) ?? cursor) : cursor + 1;
}

function edit(labels: LoLabels, change: Snapshot): LoLabels {
  const { actions, end, cursor } = labels;
  const past = [...labels.past, { actions, end, cursor }];
  return { ...labels, ...change, cursor: bounded(labels, change.cursor), past };
}

function bounded(labels: LoLabels, state: number): number {
  return Math.min(Math.max(state, 0), lastState(labels));
}
