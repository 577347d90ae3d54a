// When a user was here last, in words.
import { t } from '../language/language';
import { ago } from '../ui/format';

/** Return when a user last called. Answers can come without a call, for example with an imported run. */
export function presence(lastUsed: number | null, answers: number, now: number): string {
  if (lastUsed !== null) return t(`active ${ago(lastUsed, now)}`);
  return answers > 0 ? t('not signed in') : t('never signed in');
}
