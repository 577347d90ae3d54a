// Why labels are right, in words: made from the codes of the server, so that they are in the language of the page.
import { readable } from '../api/names';
import type { Answerable, Feedback } from '../api/types';
import { t } from '../language/language';
import { listed } from '../ui/format';
import { mistakeOf, type Mark } from './review';

export type Reason = Feedback['reasons'][number];

/** Return why the right labels in the place of a mark are right, and the learner's own label if it is a mistake. */
export function reasonWords(ask: Answerable, mark: Mark, reason: Reason): string {
  const own = reason === 'shortest' ? mistakeOf(ask, mark) : null;
  const why = ofGoal(ask, mark, reason);
  return own === null ? why : `${why} ${t(`The learner chose “${readable(own)}”.`)}`;
}

function ofGoal(ask: Answerable, mark: Mark, reason: Reason): string {
  switch (ask.kind) {
    case 'inspect_full':
      return reason === 'accomplished'
        ? t('The task is accomplished in the last state.')
        : t('The task is not accomplished in the last state.');
    case 'inspect_lo':
      return ofLastState(subgoalOf(ask), reason);
    case 'label_lo':
      return ofSegment(subgoalOf(ask), mark, reason);
    case 'label_hi':
    case 'label_full':
      return reason === 'no_way' ? t('Nothing leads to the goal from here.') : ofShortest(mark);
  }
}

function ofShortest({ right }: Mark): string {
  const names = listed(right.map(readable));
  return right.length === 1
    ? t(`“${names}” is on a shortest path from here.`)
    : t(`${names} are equally good: each is on a shortest path from here.`);
}

function ofSegment(subgoal: string, { right }: Mark, reason: Reason): string {
  if (reason === 'accomplished') return t(`Here “${subgoal}” is reached, so the segment should end.`);
  if (reason === 'no_way') return t(`There is no way to “${subgoal}” from here, so the segment should end.`);
  if (reason === 'not_accomplished') return ofLastState(subgoal, reason);
  const names = listed(right.map(readable));
  return right.length === 1
    ? t(`“${names}” leads toward “${subgoal}”.`)
    : t(`${names} are equally good: each leads toward “${subgoal}”.`);
}

function ofLastState(subgoal: string, reason: Reason): string {
  return reason === 'accomplished'
    ? t(`In the last state, “${subgoal}” is reached.`)
    : t(`In the last state, “${subgoal}” is not reached.`);
}

function subgoalOf(ask: Answerable): string {
  return readable(ask.segments[0]?.subgoal ?? '');
}
