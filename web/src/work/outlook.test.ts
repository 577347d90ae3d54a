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

test('before anything was asked or reported, nobody is said to work', () => {
  const said = (seconds: number): string[] => doingWords(run({ doing: 'nothing_yet', seconds }));
  expect(said(10)).toEqual(['No learner has asked or reported anything for this run yet.']);
  expect(said(240).at(-1)).toBe('Nothing has come for 4 min. Perhaps nobody has started a learner.');
});

test('a learner is silent after its usual time, and may have stopped after several times that', () => {
  expect(doingWords(run({ seconds: 38 })).at(-1)).toContain('40 s after');
  expect(doingWords(run({ seconds: 50.3 })).at(-1)).toBe('Nothing has come from it for 50 s.');
  expect(doingWords(run({ seconds: 180 })).at(-1)).toContain('3 min, so it may have stopped');
  expect(doingWords(run({ seconds: 700, usual_seconds: 300 })).at(-1)).toBe(
    'Nothing has come from it for 12 min.',
  );
  expect(doingWords(run({ seconds: 25, usual_seconds: 2 })).at(-1)).toContain('2 s after');
});
