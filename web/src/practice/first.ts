// The first practice: it comes once per person, before the first question of a run.
import type { AnswerableKind, Me, Outlook, Practice } from '../api/types';
import { t } from '../language/language';

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

/** Return the domain to practice: the first that has practice of those whose learners are at work, if there is one. */
export function domainToPractice({ domains }: Practice, outlook: Outlook): string | null {
  const live = outlook.runs.filter((run) => run.doing !== 'finished');
  return live.map((run) => run.domain).find((domain) => domains.includes(domain)) ?? null;
}

/**
 * Return the practice queries for somebody new: one of each kind that the learners of this domain ask or, at the
 * beginning of a run, may ask. It is empty if the learners of this server are of other domains only: the practice would
 * teach nothing of use.
 */
export function firstQueries(practice: Practice, outlook: Outlook): Practice['queries'] {
  const live = outlook.runs.filter((run) => run.doing !== 'finished');
  const ours = live.filter((run) => run.domain === practice.vocabulary.domain);
  if (live.length > 0 && ours.length === 0) return [];
  const asked = new Set(ours.flatMap((run) => run.kinds));
  // Labels are asked after inspections and demonstrations: only from them on is it known which kinds a run asks.
  const isKnown = [...asked].some((kind) => kind.startsWith('label'));
  const worked = new Set(practice.examples.map((example) => example.query));
  const seen = new Set<string>();
  return practice.queries.filter(({ id, ask: { kind } }) => {
    if (worked.has(id) || seen.has(kind) || (isKnown && !asked.has(kind))) return false;
    seen.add(kind);
    return true;
  });
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
