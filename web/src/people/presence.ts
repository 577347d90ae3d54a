// When a user was here last, in words.
import { ago } from '../ui/format';

/** Return when a user last called. Answers can come without a call, for example with an imported run. */
export function presence(lastUsed: number | null, answers: number, now: number): string {
  if (lastUsed !== null) return `active ${ago(lastUsed, now)}`;
  return answers > 0 ? 'not signed in' : 'never signed in';
}
