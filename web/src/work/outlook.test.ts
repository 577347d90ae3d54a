import { expect, test } from 'vitest';
import type { RunOutlook } from '../api/types';
import { doingWords, openWords } from './outlook';

const run = (more: Partial<RunOutlook>): RunOutlook => ({
  ...{ run: 'r', name: 'r', domain: 'maze', kinds: [], demonstrations: [], open: 0 },
  ...{ doing: 'training', seconds: 5, usual_seconds: 40 },
  ...more,
});

test('open questions are counted in tens', () => {
  expect([0, 10, 20, 1_000].map(openWords)).toEqual([
    'no question is open',
    'up to 10 questions are open',
    'about 20 questions are open',
    'about 1,000 questions are open',
  ]);
});

test('a learner at work says how long that usually takes, if that is known', () => {
  expect(doingWords(run({}))).toEqual([
    'The learner is training on the answers.',
    'Its next question usually comes 40 s after the last answer.',
  ]);
  expect(doingWords(run({ doing: 'rolling_out', usual_seconds: null }))).toHaveLength(1);
  expect(doingWords(run({ doing: 'paused' }))).toHaveLength(1);
});

test('a learner that reports nothing for long may have stopped, but not before its usual time', () => {
  expect(doingWords(run({ seconds: 700 })).at(-1)).toContain('may have stopped');
  expect(doingWords(run({ seconds: 700, usual_seconds: 300 })).at(-1)).toContain('5 min after');
});
