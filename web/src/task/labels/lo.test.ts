import { describe, expect, it } from 'vitest';
import type { AskOf } from '../../api/types';
import * as lo from './lo';

const common = { episode: 0, ordinal: 0, question: '', instance: null, context: [] };
const segment = (actions: string[]) => ({
  subgoal: 'east',
  states: [...actions, 'last'],
  actions,
  frames: [],
  landmarks: [],
  action_landmarks: [],
});

/** One segment of up, right, right; the learner ended it at `end`, or nowhere. */
function loAsk(end: number | null = 3): AskOf<'label_lo'> {
  const actions = ['up', 'right', 'right'];
  const terminations = [...actions, ''].map((_, state) => state === end);
  const suggestion = { kind: 'label_lo' as const, actions, terminations };
  return { ...common, kind: 'label_lo', segments: [segment(actions)], suggestion };
}
const three = lo.loLabels(loAsk());
const press = (labels: lo.LoLabels, times: number): lo.LoLabels =>
  times === 0 ? labels : press(lo.acceptState(labels), times - 1);

describe('Label_LO', () => {
  it('costs one key per state where the learner was right, and one for the end', () => {
    expect(lo.loAnswer(press(three, 3))).toBeNull();
    expect(lo.loAnswer(press(three, 4))).toEqual({
      kind: 'label_lo',
      actions: ['up', 'right', 'right'],
      terminations: [false, false, false, true],
    });
  });

  it('lets the segment end before the learner ended it, and needs no label after that', () => {
    const done = lo.setDone(press(three, 1));
    expect(lo.loAnswer(done)).toEqual({
      kind: 'label_lo',
      actions: ['up', null, null],
      terminations: [false, true, false, false],
    });
    expect([0, 1, 2, 3].map((state) => lo.isPast(done, state))).toEqual([false, false, true, true]);
  });

  it('still needs the states before the end', () => {
    const done = lo.setDone(lo.moveTo(three, 2));
    expect(lo.loAnswer(done)).toBeNull();
    expect(lo.firstOpen(done)).toBe(0);
    expect(lo.loAnswer(lo.acceptRest(done))).toEqual({
      kind: 'label_lo',
      actions: ['up', 'right', null],
      terminations: [false, false, true, false],
    });
  });

  it('forgets the end when an action is put there or later', () => {
    const done = lo.setDone(press(three, 1));
    expect(lo.setAction(done, 'left').end).toBeNull();
    expect(lo.setAction(lo.moveTo(done, 0), 'left').end).toBe(1);
  });

  it('can say that the last state is not the end', () => {
    const never = lo.setNotDone(press(three, 3));
    expect(lo.loAnswer(never)).toEqual({
      kind: 'label_lo',
      actions: ['up', 'right', 'right'],
      terminations: [false, false, false, false],
    });
    expect(lo.setNotDone(three)).toBe(three);
  });

  it('takes no action at the last state', () => {
    const atEnd = press(three, 3);
    expect(lo.setAction(atEnd, 'up')).toBe(atEnd);
  });

  it('follows a learner that ended early, and falls back to what it did when that is overruled', () => {
    const early = lo.loLabels(loAsk(1));
    expect(lo.loAnswer(press(early, 2))).toMatchObject({ terminations: [false, true, false, false] });
    const overruled = lo.setAction(press(early, 1), 'down');
    expect(lo.acceptRest(overruled)).toMatchObject({
      actions: ['up', 'down', 'right'],
      end: null,
      cursor: 3,
    });
  });

  it('follows a learner that never ended', () => {
    const never = lo.loLabels(loAsk(null));
    expect(lo.loAnswer(press(never, 4))).toMatchObject({ terminations: [false, false, false, false] });
    expect(lo.acceptRest(never).end).toBe('never');
  });

  it('takes all before the first wrong step as right', () => {
    const wrong = lo.markFirstWrong(three, 2);
    expect(wrong).toMatchObject({ actions: ['up', 'right', null], cursor: 2 });
    const kept = lo.markFirstWrong(lo.setAction(three, 'left'), 2);
    expect(kept.actions).toEqual(['left', 'right', null]);
  });

  it('takes a later state that is pointed at as the first wrong step, and goes to any other', () => {
    expect(lo.pickState(three, 2)).toEqual(lo.markFirstWrong(three, 2));
    const wrong = lo.markFirstWrong(three, 2);
    expect(lo.pickState(wrong, 0)).toEqual(lo.moveTo(wrong, 0)); // it is labeled
    expect(lo.pickState(three, 0)).toEqual(three); // it is the first without a label
    expect(lo.pickState(three, 3)).toEqual(lo.moveTo(three, 3)); // the last state has no step
  });

  it('labels several states in one edit, and goes on where it is told or with the first without a label', () => {
    const chosen = new Map([
      [0, 'left'],
      [2, 'down'],
    ]);
    expect(lo.setActions(three, chosen, null)).toMatchObject({ actions: ['left', null, 'down'], cursor: 1 });
    const atEnd = lo.setActions(three, chosen, 3);
    expect(atEnd).toMatchObject({ actions: ['left', null, 'down'], cursor: 3 });
    expect(lo.clearLast(atEnd)).toMatchObject({ actions: [null, null, null], cursor: 0 });
    expect(lo.setActions(three, new Map(), 3)).toBe(three);
  });

  it('forgets the end when one of several actions is put there or later', () => {
    const done = lo.setDone(press(three, 1));
    expect(lo.setActions(done, new Map([[0, 'left']]), null).end).toBe(1);
    expect(
      lo.setActions(
        done,
        new Map([
          [0, 'left'],
          [2, 'left'],
        ]),
        null,
      ).end,
    ).toBeNull();
  });

  it('undoes edits one by one', () => {
    const edited = lo.setAction(lo.markFirstWrong(three, 1), 'down');
    expect(lo.clearLast(edited)).toMatchObject({ actions: ['up', null, null], cursor: 1 });
    expect(lo.clearLast(lo.clearLast(edited))).toMatchObject({ actions: [null, null, null], cursor: 0 });
  });

  it('asks only for the end of a segment without actions', () => {
    const none = lo.loLabels({ ...common, kind: 'label_lo', segments: [segment([])], suggestion: null });
    expect(lo.loAnswer(none)).toBeNull();
    expect(lo.loAnswer(lo.acceptState(none))).toEqual({
      kind: 'label_lo',
      actions: [],
      terminations: [true],
    });
  });
});

describe('Label_FULL', () => {
  const segments = [segment(['up', 'right']), segment(['down'])];
  const full = lo.loLabels({ ...common, kind: 'label_full', segments, suggestion: null });

  it('joins the segments and knows no end', () => {
    expect(full.suggested).toEqual({ actions: ['up', 'right', 'down'], end: null });
    expect(lo.lastState(full)).toBe(2);
    expect(lo.setDone(full)).toBe(full);
  });

  it('is complete with an action at every state', () => {
    const all = press(lo.setAction(full, 'left'), 2);
    expect(lo.loAnswer(all)).toEqual({ kind: 'label_full', actions: ['left', 'right', 'down'] });
    expect(all.cursor).toBe(2);
  });

  it('goes back to a state that was passed over', () => {
    expect(lo.acceptState(lo.acceptState(lo.moveTo(full, 2))).cursor).toBe(0);
    expect(lo.loAnswer(lo.acceptRest(full))).toMatchObject({ actions: ['up', 'right', 'down'] });
  });
});
