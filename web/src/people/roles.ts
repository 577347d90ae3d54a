// The roles, and what each role may do.
import type { Role, Scope } from '../api/types';
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

/** Return the scopes that are of use for a token of a user with this role. Each of them includes `read`. */
export function scopesOf(role: Role): readonly Scope[] {
  const all: Readonly<Record<Role, readonly Scope[]>> = {
    annotator: ['read', 'answer', 'manage'],
    viewer: ['read', 'manage'],
    learner: ['read', 'learn', 'manage'],
    admin: ['read', 'answer', 'learn', 'manage'],
  };
  return all[role];
}

/** Return what a scope permits. */
export function wordsOfScope(scope: Scope, role: Role): string {
  const all: Readonly<Record<Scope, string>> = {
    read: t('see what the account sees'),
    answer: t('answer questions'),
    learn: t('create runs, ask and use answers'),
    manage: role === 'admin' ? t('manage people and tokens') : t('manage its own tokens'),
  };
  return all[scope];
}
