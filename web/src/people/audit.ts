// The audit log in words, and the days that its filter takes.
import type { AuditAction, AuditPage } from '../api/types';
import { t } from '../language/language';

/** Return what each action is called. */
export function namesOfActions(): Readonly<Record<AuditAction, string>> {
  return {
    login: t('logged in'),
    'login.refused': t('✕ login refused'),
    logout: t('logged out'),
    'link.created': t('made a login link'),
    'permission.refused': t('✕ not permitted'),
    'run.deleted': t('deleted a run'),
    'token.created': t('created a token'),
    'token.revoked': t('revoked a token'),
    'user.created': t('created a user'),
    'user.identified': t('connected a user with the sign-in'),
    'user.role_changed': t('changed a role'),
    'user.deactivated': t('deactivated a user'),
    'user.reactivated': t('reactivated a user'),
    'user.erased': t('deleted the data of a user'),
  };
}

/** Return an action by its name, or null if there is none of this name. */
export function actionOf(text: string | null): AuditAction | null {
  return text !== null && Object.hasOwn(namesOfActions(), text) ? (text as AuditAction) : null;
}

/** Return the details of a row as text: name: ada, role: viewer. */
export function detailsOf(details: AuditPage['rows'][number]['details']): string {
  return Object.entries(details)
    .filter(([, value]) => value !== null && value !== '')
    .map(([name, value]) => `${name.replace('_', ' ')}: ${wordsOf(value)}`)
    .join(', ');
}

function wordsOf(value: unknown): string {
  return typeof value === 'string' ? value : JSON.stringify(value);
}

/** Return the first moment of a day like 2026-03-01, in the time zone of the browser; null if it is no day. */
export function startOfDay(day: string): number | null {
  const [, year, month, date] = /^(\d{4})-(\d\d)-(\d\d)$/.exec(day) ?? [];
  if (year === undefined) return null;
  return Math.max(0, new Date(Number(year), Number(month) - 1, Number(date)).getTime() / 1000);
}

/** Return the first moment after a day; null if it is no day. */
export function endOfDay(day: string): number | null {
  const start = startOfDay(day);
  if (start === null) return null;
  const next = new Date(start * 1000);
  next.setDate(next.getDate() + 1); // a day can have 23 or 25 hours
  return next.getTime() / 1000;
}
