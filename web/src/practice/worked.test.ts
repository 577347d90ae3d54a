import { expect, test } from 'vitest';
import type { Vocabulary } from '../api/types';
import { commandsOf, formOf, rowAt, rowsOf, sceneAt, whyNow, type Worked } from './worked';

const vocabulary: Vocabulary = {
  domain: 'corridor',
  renderer: 'corridor',
  subgoals: ['door', 'target'],
  actions: ['left', 'right'],
};
const segment = (subgoal: string | null, ...actions: string[]) => ({ subgoal, actions });
const worked = (ask: object, ...segments: object[]): Worked =>
  ({
    ask: { kind: 'hier_demo', state: 0, instance: {}, context: [], flat: false, max_segments: 3, ...ask },
    answer: { kind: 'hier_demo', segments, replay: { states: [0, 1, 2, 3], frames: [], landmarks: [] } },
  }) as unknown as Worked;
const whole = worked({}, segment('door', 'right', 'right'), segment('target', 'right'));
const failed = { subgoal: 'target', states: [9, 0], actions: ['left'], frames: [], landmarks: [] };
const playOn = worked({ context: [failed], max_segments: 1 }, segment('door', 'right', 'right', 'left'));
const flat = worked({ flat: true }, segment(null, 'right', 'right', 'right'));
const does = (one: Worked): string[] => rowsOf(one).map((row) => `${row.does} ${row.last}`);

test('a demonstration is a list of choices, steps and ends of subgoals; the episode ends the last one', () => {
  expect(does(whole)).toEqual(['choose 1', 'act 3', 'reach 4', 'choose 5', 'act 6', 'send 7']);
  expect(does(flat)).toEqual(['act 3', 'send 4']);
});

test('where the learner failed, this comes first, and a subgoal is reached at the end', () => {
  expect(does(playOn)).toEqual(['fail 0', 'choose 1', 'act 4', 'reach 5', 'send 6']);
  expect(whyNow(rowsOf(playOn), 0)).toContain('tried “target” and did not reach it');
});

test('each moment belongs to one row', () => {
  expect([0, 1, 2, 3, 4, 5, 6, 7].map((moment) => rowAt(rowsOf(whole), moment))).toEqual([
    0, 0, 1, 1, 2, 3, 4, 5,
  ]);
});

test('each moment shows the states so far, and the subgoal that is chosen', () => {
  const seen = [0, 1, 2, 4, 5, 6, 7].map((moment) => sceneAt(whole, vocabulary, moment));
  expect(seen.map(({ at, current }) => [at, current])).toEqual([
    [0, null],
    [0, 0],
    [1, 0],
    [2, null],
    [2, 1],
    [3, 1],
    [3, 1],
  ]);
  expect(seen.map(({ labels }) => labels.map(({ name }) => name))).toEqual([
    [],
    ['door'],
    [],
    [],
    ['target'],
    [],
    [],
  ]);
  expect(seen.map(({ tape }) => tape.goesOn)).toEqual([true, true, true, true, true, false, false]);
});

test('what the learner did before is shown, too, with its failure', () => {
  const { tape, at, current } = sceneAt(playOn, vocabulary, 2);
  expect(tape.stretches.map(({ failed: hasFailed }) => hasFailed)).toEqual([true, undefined]);
  expect([at, current]).toEqual([2, 1]);
});

test('each row has its keys: the same key several times is said once', () => {
  const keys = rowsOf(playOn).map((row) => commandsOf(row, formOf(playOn.ask), vocabulary));
  expect(keys).toEqual([
    [],
    [['choose:0', 1]],
    [
      ['act:1', 2],
      ['act:0', 1],
    ],
    [['reached', 1]],
    [['reached', 1]],
  ]);
  const flatKeys = rowsOf(flat).map((row) => commandsOf(row, formOf(flat.ask), vocabulary));
  expect(flatKeys).toEqual([[['act:1', 3]], [['send', 1]]]);
});
