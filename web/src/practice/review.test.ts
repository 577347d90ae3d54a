import { expect, test } from 'vitest';
import { labelWords } from '../api/names';
import type { Answerable } from '../api/types';
import { buildTape } from '../player/tape';
import { choicesWords, firstToSee, frameOf, mistakeOf, placeOf, verdictWords, type Mark } from './review';

const segment = (subgoal: string, from: number, n: number) => ({
  subgoal,
  states: Array.from({ length: n + 1 }, (_, step) => [1, from + step]),
  actions: Array.from({ length: n }, () => 'right'),
  frames: [],
  landmarks: [],
  action_landmarks: [],
});
const before = segment('north', 0, 2);
const ask = (kind: string, segments: object[]): Answerable =>
  ({ kind, segments, context: [before] }) as unknown as Answerable;
const mark = (place: number, is_right = false): Mark => ({ place, given: 'up', right: ['down'], is_right });

test('a label is shown where it belongs', () => {
  const segments = [segment('east', 2, 3), segment('west', 5, 2)];
  const tape = buildTape([before], segments);
  expect(frameOf(ask('label_hi', segments), tape, mark(1))).toBe(5);
  expect(frameOf(ask('label_full', segments), tape, mark(0))).toBe(2);
  expect(frameOf(ask('label_full', segments), tape, mark(4))).toBe(6);
  expect(frameOf(ask('inspect_full', segments), tape, mark(0))).toBe(7);
});

test('the end of a segment is a label too', () => {
  const segments = [segment('east', 2, 3)];
  expect(frameOf(ask('label_lo', segments), buildTape([before], segments), mark(3))).toBe(5);
  expect([labelWords('(done)'), labelWords('(not done)'), labelWords(null)]).toEqual([
    'done here',
    'not done',
    'nothing',
  ]);
});

test('labels and their places are put in words', () => {
  expect(placeOf(ask('label_hi', []), mark(1))).toBe('Segment 2');
  expect(placeOf(ask('label_lo', []), mark(4))).toBe('State 5');
  expect(choicesWords(['go_to_target', 'east'])).toBe('go to target or east');
});

test('the first wrong label is looked at first', () => {
  const hi = ask('label_hi', [segment('east', 2, 3), segment('down', 5, 2), segment('west', 7, 1)]);
  expect(firstToSee(hi, [mark(0, true), mark(1, false), mark(2, false)])).toBe(1);
  expect(firstToSee(ask('inspect_lo', []), [mark(0, true)])).toBe(0);
});

test.each([
  [[true], 'Right'],
  [[false], 'Not right'],
  [[true, true], 'Right'],
  [[true, false, false], '1 of 3 right'],
])('%j is %s', (right, words) => {
  expect(verdictWords(right.map((is_right, place) => mark(place, is_right)))).toBe(words);
});

test('a right answer shows what the learner did wrong', () => {
  const down = (place: number): Mark => ({ ...mark(place, true), given: 'down' });
  const hi = ask('label_hi', [segment('down', 2, 3), segment('east', 5, 2)]);
  expect([0, 1].map((place) => mistakeOf(hi, down(place)))).toEqual([null, 'east']);
  expect(firstToSee(hi, [down(0), down(1)])).toBe(1);
  const lo = { ...ask('label_lo', [segment('east', 2, 1)]), suggestion: { terminations: [false, true] } };
  const end = { ...mark(1, true), given: '(not done)', right: ['(not done)'] };
  const labels = lo as unknown as Answerable;
  expect([down(0), end].map((one) => mistakeOf(labels, one))).toEqual(['right', '(done)']);
  expect(mistakeOf(ask('inspect_lo', [segment('east', 2, 1)]), down(0))).toBeNull();
});
