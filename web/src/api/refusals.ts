// What the page says, in its own language, when the server refuses what an annotator wants.
import { t } from '../language/language';

/**
 * Return the words for a refusal, by its stable name. Undefined where the server's own words say more: which field is
 * not valid, which role is missing.
 */
export function refusalWords(name: string): string | undefined {
  const words: Readonly<Record<string, string>> = {
    unauthenticated: t('You are not signed in, or no longer. Open a new login link.'),
    'login-used': t('Each login link works once. Ask for a new one.'),
    'login-expired': t('It was not used in time.'),
    deactivated: t('Ask an administrator of this server.'),
    'sign-in-stale': t('It was not begun in this browser, or it took longer than ten minutes.'),
    'no-account': t('Ask an administrator of this server for one.'),
    'no-role': t('Ask an administrator of this server for one.'),
    'not-yours': t('Somebody else has this question.'),
    'wrong-token': t('Another tab has this question.'),
    'not-found': t('It does not exist, or it was deleted.'),
    'lease-expired': t('The question went back to the queue before.'),
    'lease-ended': t('The question was answered, skipped or given back before.'),
    'query-cancelled': t('The run has ended, and its open questions with it.'),
    'different-content': t('It has another answer already.'),
    'answer-retracted': t('The answer was taken back or sent back before.'),
    'not-playable': t('It is answered, or nobody asks it any more.'),
    displaced: t('It is open in another tab or browser.'),
    'body-too-large': t('It is too long.'),
  };
  return Object.hasOwn(words, name) ? words[name] : undefined;
}
