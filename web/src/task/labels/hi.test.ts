import { describe, expect, it } from 'vitest';
import type { AskOf } from '../../api/types';
import {
  acceptRemaining,
  acceptSubgoal,
  clearLast,
  hiAnswer,
  hiLabels,
  moveTo,
  setSubgoal,
  setSubgoals,
} from './hi';

function ask(subgoals: (string | null)[], suggestion: string[] | null = null): AskOf<'label_hi'> {
  return {
    kind: 'label_hi',
    episode: 0,
    ordinal: 0,
    question: '',
    instance: null,
    context: [],
    segments: subgoals.map((subgoal) => ({
      subgoal,
      states: [0],
      actions: [],
      frames: [],
      landmarks: [],
      action_landmarks: [],
    })),
    suggestion: suggestion && { kind: 'label_hi', subgoals: suggestion },
  };
}
const three = hiLabels(ask(['north', 'north', 'east']));

describe('Label_HI', () => {
  it("suggests the learner's own subgoals where it sent no suggestion", () => {
    expect(three.suggested).toEqual(['north', 'north', 'east']);
    expect(hiLabels(ask(['north'], ['west'])).suggested).toEqual(['west']);
  });

  it('labels several segments in one edit, and goes on with the first without a label', () => {
    const two = setSubgoals(
      three,
      new Map([
        [0, 'west'],
        [2, 'south'],
      ]),
    );
    expect(two).toMatchObject({ subgoals: ['west', null, 'south'], cursor: 1 });
    expect(clearLast(two)).toMatchObject({ subgoals: [null, null, null], cursor: 0 });
    const all = setSubgoals(
      two,
      new Map([
        [0, 'north'],
        [1, 'east'],
      ]),
    );
    expect(all).toMatchObject({ subgoals: ['north', 'east', 'south'], cursor: 1 });
    expect(setSubgoals(three, new Map())).toBe(three);
  });

  it('has no answer until every segment is labeled', () => {
    const two = acceptSubgoal(acceptSubgoal(three));
    expect(hiAnswer(two)).toBeNull();
    expect(hiAnswer(acceptSubgoal(two))).toEqual({ kind: 'label_hi', subgoals: ['north', 'north', 'east'] });
  });

  it('labels the current segment and moves to the next', () => {
    const one = setSubgoal(three, 'west');
    expect(one.subgoals).toEqual(['west', null, null]);
    expect(one.cursor).toBe(1);
  });

  it('keeps what a segment already has when it is accepted', () => {
    const back = moveTo(setSubgoal(three, 'west'), 0);
    expect(acceptSubgoal(back).subgoals[0]).toBe('west');
  });

  it('goes back to a segment that was passed over', () => {
    const last = acceptSubgoal(moveTo(three, 2));
    expect(last.cursor).toBe(0);
  });

  it('accepts the rest, and keeps changed labels', () => {
    expect(acceptRemaining(setSubgoal(three, 'west')).subgoals).toEqual(['west', 'north', 'east']);
  });

  it('accepts nothing where the learner chose nothing', () => {
    const flat = hiLabels(ask([null]));
    expect(acceptSubgoal(flat)).toBe(flat);
    expect(hiAnswer(acceptRemaining(flat))).toBeNull();
  });

  it('undoes edits one by one, and stops at the first', () => {
    const two = setSubgoal(setSubgoal(three, 'west'), 'south');
    const one = clearLast(two);
    expect(one.subgoals).toEqual(['west', null, null]);
    expect(one.cursor).toBe(1);
    expect(clearLast(clearLast(one)).subgoals).toEqual([null, null, null]);
  });

  it('keeps the cursor on the segments', () => {
    expect(moveTo(three, -5).cursor).toBe(0);
    expect(moveTo(three, 9).cursor).toBe(2);
  });
});
