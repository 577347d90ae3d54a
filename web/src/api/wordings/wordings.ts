// The standard wordings of learners and of the server, which the page says in its own language.
import { t } from '../../language/language';
import WORDINGS from './wordings.json';

type Name = keyof typeof WORDINGS;
const NAMES = Object.keys(WORDINGS) as Name[];
const PART = '{}'; // stands for the name of a subgoal, or for a number

/** Return a question, or why a forecast comes too early, in the language of the page; other wordings as they are. */
export function inOurWords(text: string): string {
  for (const name of NAMES) {
    const part = partOf(text, WORDINGS[name]);
    if (part !== null) return translated(part)[name];
  }
  return text;
}

/** Return what stands for the part of a wording, empty if it has none; null if the text has another wording. */
function partOf(text: string, wording: string): string | null {
  const [before = '', after] = wording.split(PART);
  if (after === undefined) return text === wording ? '' : null;
  const isLongEnough = text.length >= before.length + after.length;
  if (!isLongEnough || !text.startsWith(before) || !text.endsWith(after)) return null;
  return text.slice(before.length, text.length - after.length);
}

/** Return every wording in the language of the page. In English, they are those of the file. */
export function translated(part: string): Readonly<Record<Name, string>> {
  return {
    whole: t('Did it do the whole task?'),
    subgoals: t('Which subgoal should it have chosen for each segment?'),
    subgoal: t('Which subgoal should it have chosen for this segment?'),
    attempt: t(`It tried “${part}”. Did that work?`),
    segment: t(`It tried “${part}”. What should it have done at each step?`),
    steps: t('What should it have done at each step?'),
    show: t('Do the whole task yourself.'),
    showSubgoals: t('Do the whole task yourself, one subgoal after the other.'),
    showSubgoal: t('Do the whole task yourself, until a subgoal is reached.'),
    playOn: t('Play on from here.'),
    playOnUntilReached: t('Play on until a subgoal is reached.'),
    failed: t(`It failed at “${part}”. Play on from here.`),
    failedSubgoals: t(`It failed at “${part}”. Play on from here, one subgoal after the other.`),
    failedSubgoal: t(`It failed at “${part}”. Play on from here, until a subgoal is reached.`),
    newAndShort: t(
      `There is no finished run of this domain and algorithm to compare with, and its own curve says nothing before 10 successful tests; it has ${part}.`,
    ),
    newAndUnclear: t(
      'There is no finished run of this domain and algorithm to compare with, and its own curve does not show yet whether it gets there.',
    ),
    otherAndShort: t(
      `No finished run is enough like this one, and its own curve says nothing before 10 successful tests; it has ${part}.`,
    ),
    otherAndUnclear: t(
      'No finished run is enough like this one, and its own curve does not show yet whether it gets there.',
    ),
  };
}
