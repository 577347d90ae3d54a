import { describe, expect, it } from 'vitest';
import type { AskOf, PlayStates, Price, Segment } from '../api/types';
import * as demos from './demonstration';
import type { Demonstration, Move } from './demonstration';

const ask = {
  kind: 'hier_demo',
  state: 's1',
  context: [],
  flat: false,
  max_segments: 2,
  max_actions: 4,
} as unknown as AskOf<'hier_demo'>;
const flat = { ...ask, flat: true };
const price: Price = { fixed: 0, per_action: 1, per_segment: 110 };

const north: Move = { does: 'choose', subgoal: 'north' };
const east: Move = { does: 'choose', subgoal: 'east' };
const up: Move = { does: 'act', action: 'up' };
const right: Move = { does: 'act', action: 'right' };
const reach: Move = { does: 'reach' };
const restart: Move = { does: 'restart' };

const news = (known: number, states: string[], more: Partial<PlayStates> = {}): PlayStates => ({
  type: 'states',
  number: 1,
  known,
  states,
  frames: [],
  landmarks: [],
  action_landmarks: [],
  ended: false,
  succeeded: false,
  ...more,
});
const played = (...moves: Move[]): Demonstration => moves.reduce(demos.make, demos.begin(ask));

describe('a demonstration from where the learner failed', () => {
  const walked = (subgoal: string, states: string[], actions: string[], frames: string[] = []): Segment => ({
    subgoal,
    states,
    actions,
    frames,
    landmarks: [],
    action_landmarks: [],
  });
  const context = [
    walked('east', ['s-2', 's-1'], ['right'], ['a', 'b']),
    walked('north', ['s-1', 's0', 's1'], ['up', 'left'], ['b', 'c', 'd']),
  ];
  const on = { ...ask, max_segments: 1, context };

  it('is on one tape with what the learner did, whose last segment failed', () => {
    const tape = demos.tapeOf(
      demos.learn(played(north, up, up), news(1, ['s2', 's3'], { frames: ['e', 'f'] })),
      on,
    );
    expect(tape.frames).toEqual(['s-2', 's-1', 's0', 's1', 's2', 's3']);
    expect(tape.pictures).toEqual(['a', 'b', 'c', 'd', 'e', 'f']);
    expect(tape.start).toBe(3);
    expect(
      tape.stretches.map(({ index, first, last, asked, failed }) => [index, first, last, asked, failed]),
    ).toEqual([
      [0, 0, 1, false, undefined],
      [1, 1, 3, false, true],
      [2, 3, 5, true, undefined],
    ]);
  });

  it('is complete with the last segment that may be played, once it is reached', () => {
    expect(demos.isComplete(played(north, up), on)).toBe(false);
    expect(demos.isComplete(played(north, up, reach), on)).toBe(true);
    expect(demos.isComplete(played(north, up, reach), ask)).toBe(false);
    expect(demos.obstacle(played(north, up, reach), on, north)).toContain('at most 1 segment');
  });
});

describe('a demonstration', () => {
  it('is a list of segments, each with its subgoal and actions', () => {
    const demonstration = played(north, up, up, reach, east, right);
    expect(demos.segmentsOf(demonstration)).toEqual([
      { subgoal: 'north', actions: ['up', 'up'] },
      { subgoal: 'east', actions: ['right'] },
    ]);
    expect(demos.partsOf(demonstration).map((part) => part.reached)).toEqual([true, false]);
  });

  it('takes the last choice before the first step, and leaves out a subgoal without one', () => {
    expect(demos.segmentsOf(played(north, east, right, reach, north))).toEqual([
      { subgoal: 'east', actions: ['right'] },
    ]);
  });

  it('has one segment without a subgoal where only actions are wanted', () => {
    expect(demos.segmentsOf(played(up, right))).toEqual([{ subgoal: null, actions: ['up', 'right'] }]);
  });

  it('costs a label per action, subgoal and termination; a flat one its actions', () => {
    expect(demos.costOf(played(north, up, up, reach, east, right), price)).toBe(3 + 2 * 110);
    expect(demos.costOf(played(up, right), price)).toBe(2);
    expect(demos.costOf(played(north), price)).toBe(0);
    expect(demos.costOf(played(north, up), { fixed: 5, per_action: 1, per_segment: 110 })).toBe(5 + 1 + 110);
  });
});

describe('what cannot be done', () => {
  it.each<[string, Demonstration, Move]>([
    ['a step before a subgoal', played(), up],
    ['a step after the subgoal is reached', played(north, up, reach), up],
    ['another subgoal before this one is reached', played(north, up), east],
    ['more segments than H_HI', played(north, up, reach, east, right, reach), north],
    ['more steps than H_FULL', played(north, up, up, up, up), up],
    ['to have reached a subgoal without a step', played(north), reach],
    ['to have reached what was not chosen', played(north, up, reach), reach],
    ['to start over before the start', played(north, up, restart), restart],
    ['to go on after the end', demos.learn(played(north, up), news(1, ['s2'], { ended: true })), up],
  ])('is %s', (_what, demonstration, move) => {
    expect(demos.obstacle(demonstration, ask, move)).not.toBeNull();
  });

  it('is nothing else', () => {
    let demonstration = demos.begin(ask);
    for (const move of [
      north,
      east,
      right,
      up,
      reach,
      north,
      up,
      up,
      restart,
      north,
      up,
      up,
      up,
      up,
      reach,
      east,
    ]) {
      expect(demos.obstacle(demonstration, ask, move)).toBeNull();
      demonstration = demos.make(demonstration, move);
    }
    expect(demos.obstacle(demos.begin(flat), flat, up)).toBeNull();
  });
});

describe('states', () => {
  it('follow the steps, after the states that were known', () => {
    const demonstration = played(north, up, up);
    expect(demos.isBehind(demonstration)).toBe(true);
    expect(demos.answerOf(demonstration, false)).toBeNull();
    const seen = demos.learn(demonstration, news(1, ['s2', 's3']));
    expect(seen.states).toEqual(['s1', 's2', 's3']);
    expect(demos.isBehind(seen)).toBe(false);
    expect(demos.learn(demos.make(seen, up), news(3, ['s4'])).states).toEqual(['s1', 's2', 's3', 's4']);
    expect(demos.answerOf(seen, false)?.segments).toEqual([{ subgoal: 'north', actions: ['up', 'up'] }]);
  });

  it('are on the tape as far as they are known', () => {
    const tape = demos.tapeOf(demos.learn(played(north, up, reach, east, right), news(1, ['s2'])), ask);
    expect(tape.frames).toEqual(['s1', 's2']);
    expect(tape.stretches.map(({ first, last, actions }) => [first, last, actions])).toEqual([
      [0, 1, ['up']],
      [1, 1, []],
    ]);
  });

  it('end the episode, and drop the moves after its end', () => {
    const ahead = played(north, up, right, reach, east, right);
    const over = demos.learn(ahead, news(1, ['s2', 's3'], { ended: true, succeeded: true }));
    expect(over.moves).toEqual([north, up, right, reach, east]);
    expect([over.ended, over.succeeded]).toEqual([true, true]);
    expect(demos.answerOf(over, false)?.segments).toEqual([{ subgoal: 'north', actions: ['up', 'right'] }]);
  });

  it('go with the steps that are taken back, and the end with them', () => {
    const over = demos.learn(played(north, up, up), news(1, ['s2', 's3'], { ended: true }));
    const back = demos.takeBack(over);
    expect([back.states, back.ended]).toEqual([['s1', 's2'], false]);
    const reached = demos.learn(played(north, up, reach), news(1, ['s2'], { ended: true }));
    expect(demos.takeBack(reached)).toMatchObject({ states: ['s1', 's2'], ended: true });
  });

  it('are forgotten on starting over, which can be taken back', () => {
    const seen = demos.learn(played(north, up), news(1, ['s2']));
    const fresh = demos.make(seen, restart);
    expect([fresh.states, demos.partsOf(fresh)]).toEqual([['s1'], []]);
    const again = demos.takeBack(fresh);
    expect(demos.segmentsOf(again)).toEqual([{ subgoal: 'north', actions: ['up'] }]);
    expect(demos.isBehind(again)).toBe(true);
  });
});
