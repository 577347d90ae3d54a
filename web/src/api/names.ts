// The names that people read: of the kinds of query, of subgoals and of actions.
import { t } from '../language/language';
import type { Kind } from './types';

/** The paper's names of the queries. */
export const KIND_NAMES: Readonly<Record<Kind, string>> = {
  hier_demo: 'HierDemo',
  inspect_full: 'Inspect_FULL',
  label_hi: 'Label_HI',
  inspect_lo: 'Inspect_LO',
  label_lo: 'Label_LO',
  label_full: 'Label_FULL',
};

/** Return what annotators read instead: what a query of each kind asks for. */
export function kindWords(): Readonly<Record<Kind, string>> {
  return {
    hier_demo: t('Show the whole task'),
    inspect_full: t('Did the whole task work?'),
    label_hi: t('Choose the subgoals'),
    inspect_lo: t('Did this segment work?'),
    label_lo: t('Correct the steps of a segment'),
    label_full: t('Correct every step'),
  };
}

/** Return the names of the kinds: the paper's for those who run the learner, plain words for annotators. */
export function namesOfKinds(papers: boolean): Readonly<Record<Kind, string>> {
  return papers ? KIND_NAMES : kindWords();
}

/** Return a name as people read it: "go_to_target" becomes "go to target". */
export function readable(name: string): string {
  return name.replaceAll('_', ' ');
}

/** Return a label in words; the end of a segment is a label too. */
export function labelWords(label: string | null): string {
  if (label === null) return t('nothing');
  if (label === '(done)') return t('done here');
  if (label === '(not done)') return t('not done');
  if (label === 'pass') return t('yes, it worked');
  if (label === 'fail') return t('no, it failed');
  return readable(label);
}

/** Return the letter that stands for a subgoal: N for north, T for go_to_target. */
export function initial(name: string): string {
  return name
    .replace(/^(go_)?to_/i, '')
    .charAt(0)
    .toUpperCase();
}

const ARROWS: Readonly<Record<string, string>> = { up: '↑', down: '↓', left: '←', right: '→' };

/** Return the arrow of an action that has a direction, else its name. */
export function arrowOrName(action: string): string {
  return ARROWS[action] ?? readable(action);
}
