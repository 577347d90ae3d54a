// The names of roles, of states and of reasons, as people read them.
import { t } from '../language/language';
import type { QueryRow, Role, Run } from './types';

export function nameOfRole(role: Role): string {
  const names: Readonly<Record<Role, string>> = {
    annotator: t('annotator'),
    viewer: t('viewer'),
    learner: t('learner'),
    admin: t('admin'),
  };
  return names[role];
}

export function nameOfRunState(state: Run['state']): string {
  const names: Readonly<Record<Run['state'], string>> = {
    running: t('running'),
    paused: t('paused'),
    finished: t('finished'),
  };
  return names[state];
}

export function nameOfQueryState(state: QueryRow['state']): string {
  const names: Readonly<Record<QueryRow['state'], string>> = {
    open: t('open'),
    leased: t('leased'),
    answered: t('answered'),
    cancelled: t('cancelled'),
  };
  return names[state];
}

/** Return the reasons to skip that the page offers, as the server keeps them and as people read them. */
export function reasonsToSkip(): ReadonlyMap<string, string> {
  // eslint-disable-next-line waypost/untranslated -- the server keeps them in English, whoever chose them
  const kept = ['I cannot tell', 'The picture is wrong', 'The question is unclear'];
  const read = [t('I cannot tell'), t('The picture is wrong'), t('The question is unclear')];
  return new Map(kept.map((reason, index) => [reason, read[index] ?? reason]));
}
