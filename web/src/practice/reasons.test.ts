import { expect, test } from 'vitest';
import type { Answerable } from '../api/types';
import { reasonWords } from './reasons';
import type { Mark } from './review';

const ask = (kind: string): Answerable =>
  ({
    kind,
    segments: [{ subgoal: 'go_to_target', states: [0, 1], actions: ['down'] }],
    suggestion: null,
  }) as unknown as Answerable;
const mark = (...right: string[]): Mark => ({ place: 0, given: right[0] ?? null, right, is_right: true });

test.each([
  ['inspect_full', mark('fail'), 'not_accomplished', 'The task is not accomplished in the last state.'],
  ['inspect_lo', mark('pass'), 'accomplished', 'In the last state, “go to target” is reached.'],
  ['label_hi', mark('go_to_target'), 'shortest', '“go to target” is on a shortest path from here.'],
  ['label_lo', mark('(done)'), 'accomplished', 'Here “go to target” is reached, so the segment should end.'],
  ['label_lo', mark('(not done)'), 'not_accomplished', 'In the last state, “go to target” is not reached.'],
  [
    'label_lo',
    mark('(done)'),
    'no_way',
    'There is no way to “go to target” from here, so the segment should end.',
  ],
  ['label_lo', mark('down'), 'shortest', '“down” leads toward “go to target”.'],
  ['label_full', mark('up', 'down'), 'no_way', 'Nothing leads to the goal from here.'],
] as const)('%s, %j, %s', (kind, one, reason, words) => {
  expect(reasonWords(ask(kind), one, reason)).toBe(words);
});

test('several right labels are equally good, and a mistake of the learner is named', () => {
  expect(reasonWords(ask('label_lo'), mark('up', 'down'), 'shortest')).toBe(
    'up, down are equally good: each leads toward “go to target”.',
  );
  expect(reasonWords(ask('label_full'), mark('up', 'left'), 'shortest')).toBe(
    'up, left are equally good: each is on a shortest path from here. The learner chose “down”.',
  );
});
