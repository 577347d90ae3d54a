// The roles, and what each role may do.
import type { Role } from '../api/types';
import { t } from '../language/language';

/** The roles, in the order in which they are offered. */
export const ROLES: readonly Role[] = ['annotator', 'viewer', 'learner', 'admin'];

/** Return what a role may do. */
export function mayOf(role: Role): string {
  const all: Readonly<Record<Role, string>> = {
    annotator: t('Answers questions; sees runs and their curves, but no single queries.'),
    viewer: t('Sees everything except people, and changes nothing.'),
    learner: t(
      'A program: creates runs, asks queries in them, uses the answers, and sees everything except people.',
    ),
    admin: t('May do everything, including adding people.'),
  };
  return all[role];
}
