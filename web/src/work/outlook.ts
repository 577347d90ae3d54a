// What an annotator can expect, in words: what the learner does, how long that usually takes, what is left to answer.
import type { RunOutlook } from '../api/types';
import { t } from '../language/language';
import { number, seconds } from '../ui/format';

/** A learner is silent after its usual time or these seconds, whichever is longer; after `times` as long, it may have stopped. */
const SILENT = { seconds: 30, times: 4 };

/** Return how many questions are open. The server counts in tens, so that no gold query can be noticed. */
export function openWords(open: number): string {
  if (open === 0) return t('no question is open');
  return open <= 10 ? t('up to 10 questions are open') : t(`about ${number(open)} questions are open`);
}

function doing(): Readonly<Record<RunOutlook['doing'], string>> {
  return {
    nothing_yet: t('No learner has asked or reported anything for this run yet.'),
    asking: t(
      'The learner waits for answers to questions that others have now, or that you skipped or leave to others.',
    ),
    training: t('The learner is training on the answers.'),
    rolling_out: t('The learner is trying its task, until it has something to ask.'),
    paused: t('The run is paused. The learner asks again when somebody resumes it.'),
    finished: t('The run is finished. Its learner asks nothing more.'),
  };
}

/** Return what the learner of a run does, and how long it usually takes until its next question. */
export function doingWords(run: RunOutlook): string[] {
  const words = [doing()[run.doing]];
  if (run.doing === 'nothing_yet') return [...words, ...neverHeard(run.seconds)];
  if (run.doing !== 'training' && run.doing !== 'rolling_out') return words;
  const usual = run.usual_seconds;
  if (usual !== null)
    words.push(t(`Its next question usually comes ${seconds(usual)} after the last answer.`));
  return [...words, ...silence(run.seconds, Math.max(SILENT.seconds, usual ?? 0))];
}

function neverHeard(passed: number): string[] {
  if (passed <= SILENT.seconds) return [];
  return [t(`Nothing has come for ${seconds(Math.round(passed))}. Perhaps nobody has started a learner.`)];
}

function silence(passed: number, usual: number): string[] {
  if (passed <= usual) return [];
  const silent = seconds(Math.round(passed));
  return passed > SILENT.times * usual
    ? [t(`Nothing has come from it for ${silent}, so it may have stopped.`)]
    : [t(`Nothing has come from it for ${silent}.`)];
}
