// The first practice: it comes once per person, before the first question of a run.
import type { AnswerableKind, Me, Outlook, Practice } from '../api/types';
import { t } from '../language/language';
import { formOf, type Worked } from './worked';

const KEY = 'waypost.practiced.';

/** Return whether a person should practice first: an annotator who has answered nothing, here or elsewhere. */
export function isNew(me: Me, storage: Storage): boolean {
  return me.role === 'annotator' && me.answers === 0 && storage.getItem(KEY + String(me.id)) === null;
}

/** Remember that a person has seen the first practice, so that it does not come again in this browser. */
export function remember(me: Me, storage: Storage): void {
  try {
    storage.setItem(KEY + String(me.id), 'yes');
  } catch {
    // The storage is full or forbidden: the practice comes again, and can be skipped again.
  }
}

/**
 * Return the domains to practice, of those that have practice: those whose learners are at work, in their order, or all
 * if no learner is. To somebody who works on one run, only its learner counts. Other domains would teach nothing of use.
 */
export function domainsToPractice({ domains }: Practice, outlook: Outlook, run: string | null): string[] {
  const live = outlook.runs.filter((one) => one.doing !== 'finished');
  const mine = live.filter((one) => one.run === run);
  const asking = (mine.length > 0 ? mine : live).map((one) => one.domain);
  if (asking.length === 0) return [...domains];
  return [...new Set(asking)].filter((domain) => domains.includes(domain));
}

/**
 * Return the practice queries for somebody new: one of each kind that the learners of this domain ask or, at the
 * beginning of a run, may ask. It is empty if the learners of this server are of other domains only: the practice would
 * teach nothing of use.
 */
export function firstQueries(practice: Practice, outlook: Outlook): Practice['queries'] {
  const ours = runsOf(practice, outlook);
  if (ours === null) return [];
  const asked = new Set(ours.flatMap((run) => run.kinds));
  const isKnown = knowsKinds(ours);
  const worked = new Set(practice.examples.map((example) => example.query));
  const seen = new Set<string>();
  return practice.queries.filter(({ id, ask: { kind } }) => {
    if (worked.has(id) || seen.has(kind) || (isKnown && !asked.has(kind))) return false;
    seen.add(kind);
    return true;
  });
}

/**
 * Return the demonstrations to look at for somebody new: one for each way in which the learners of this domain ask for
 * them or, at the beginning of a run, may ask. A learner that asks for flat ones asks for no others.
 */
export function firstDemonstrations(practice: Practice, outlook: Outlook): readonly Worked[] {
  const ours = runsOf(practice, outlook);
  if (ours === null) return [];
  const asked = new Set(ours.flatMap((run) => run.demonstrations));
  const isFlat = practice.vocabulary.subgoals.length === 0 || (asked.size === 1 && asked.has('flat_demo'));
  return practice.demonstrations.filter(({ ask }) => {
    const form = formOf(ask);
    return asked.has(form) || (!knowsKinds(ours) && isFlat === (form === 'flat_demo'));
  });
}

/** Return the runs of the practiced domain that go on; null if all that go on are of other domains. */
function runsOf({ vocabulary }: Practice, outlook: Outlook): Outlook['runs'] | null {
  const live = outlook.runs.filter((run) => run.doing !== 'finished');
  const ours = live.filter((run) => run.domain === vocabulary.domain);
  return live.length > 0 && ours.length === 0 ? null : ours;
}

/** Labels are asked after inspections and demonstrations: only from them on is it known what a run asks. */
function knowsKinds(runs: Outlook['runs']): boolean {
  return runs.some((run) => run.kinds.some((kind) => kind.startsWith('label')));
}

/** Return how each kind of question is answered, beside a worked example. */
export function how(): Readonly<Record<AnswerableKind, string>> {
  return {
    inspect_full: t('Watch the path to its end. Answer yes if the task is done there.'),
    inspect_lo: t('Only the last, bright segment counts. Answer yes if it did what it tried.'),
    label_hi: t(
      'For each segment, choose the subgoal that was right where the segment begins. Keep each right choice.',
    ),
    label_lo: t(
      'For each step, choose the action that was right. Keep each right one. Say where the segment should have ended.',
    ),
    label_full: t('For each step, choose the action that was right. Keep each right one.'),
  };
}
