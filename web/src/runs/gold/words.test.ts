import { expect, test } from 'vitest';
import type { Gold } from '../../api/types';
import { knownWords } from './words';

test.each<[Gold['known'], string]>([
  [{ kind: 'inspect_lo', verdict: 'fail' }, 'fail'],
  [{ kind: 'label_hi', subgoals: [['north', 'go_to_target'], ['west']] }, 'north or go to target, west'],
  [{ kind: 'label_full', actions: [['up'], ['down']] }, 'up, down'],
  [{ kind: 'label_lo', actions: [['up']], end: 1 }, 'up, done at state 2'],
  [{ kind: 'label_lo', actions: [], end: 0 }, 'done at state 1'],
  [{ kind: 'label_lo', actions: [['up']], end: null }, 'up, not done'],
])('%j is read "%s"', (known, words) => {
  expect(knownWords(known)).toBe(words);
});
