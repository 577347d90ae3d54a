// The editor for every kind of label, and the edit of each command.
import type { Answer, Answerable, Vocabulary } from '../../api/types';
import type { Command } from '../../keys/registry';
import { t } from '../../language/language';
import * as hi from './hi';
import * as lo from './lo';

/** The labels of a query; an inspection has none. */
export type Labels = hi.HiLabels | lo.LoLabels;

export function newLabels(ask: Answerable): Labels | null {
  switch (ask.kind) {
    case 'label_hi':
      return hi.hiLabels(ask);
    case 'label_lo':
    case 'label_full':
      return lo.loLabels(ask);
    default:
      return null;
  }
}

export function answerOf(labels: Labels | null): Answer | null {
  if (labels === null) return null;
  return labels.kind === 'label_hi' ? hi.hiAnswer(labels) : lo.loAnswer(labels);
}

/** Label the current segment or state with the subgoal or action that has this number in the vocabulary. */
export function choose(labels: Labels, index: number, vocabulary: Vocabulary): Labels {
  const isHi = labels.kind === 'label_hi';
  const name = (isHi ? vocabulary.subgoals : vocabulary.actions)[index];
  if (name === undefined) return labels;
  return isHi ? hi.setSubgoal(labels, name) : lo.setAction(labels, name);
}

/** Label segments or states, by their number, in one edit. `next` is the state to go on with; null: an open one. */
export function chooseAll(
  labels: Labels,
  named: readonly (readonly [number, string])[],
  next: number | null,
): Labels {
  const chosen = new Map(named);
  return labels.kind === 'label_hi' ? hi.setSubgoals(labels, chosen) : lo.setActions(labels, chosen, next);
}

export function moveTo(labels: Labels, index: number): Labels {
  return labels.kind === 'label_hi' ? hi.moveTo(labels, index) : lo.moveTo(labels, index);
}

/** The edit of each command. */
export const EDITS: Partial<Record<Command, (labels: Labels) => Labels>> = {
  accept: (labels) => (labels.kind === 'label_hi' ? hi.acceptSubgoal(labels) : lo.acceptState(labels)),
  'accept-rest': (labels) =>
    labels.kind === 'label_hi' ? hi.acceptRemaining(labels) : lo.acceptRest(labels),
  clear: (labels) => (labels.kind === 'label_hi' ? hi.clearLast(labels) : lo.clearLast(labels)),
  done: (labels) => (labels.kind === 'label_hi' ? labels : lo.setDone(labels)),
  'not-done': (labels) => (labels.kind === 'label_hi' ? labels : lo.setNotDone(labels)),
  'first-wrong': (labels) => (labels.kind === 'label_hi' ? labels : lo.markFirstWrong(labels, labels.cursor)),
  'previous-segment': (labels) => moveTo(labels, labels.cursor - 1),
  'next-segment': (labels) => moveTo(labels, labels.cursor + 1),
};

/** Return the hint that says why an edit changed nothing. */
export function hintOf(edit: Command | 'choose' | 'draw'): string {
  switch (edit) {
    case 'accept':
      return t('There is nothing to keep: the learner made no choice here.');
    case 'not-done':
      return t('“Not done” is for the last state only. At other states, choose an action.');
    case 'draw':
      return t(
        'This way passes nothing that the question is about. Draw along the learner’s path, and leave it where it is wrong.',
      );
    case 'choose':
      return t('The last state needs no action. Choose “Done here” or “Not done”.');
    default:
      return '';
  }
}
