import { describe, expect, it } from 'vitest';
import * as players from './player';
import {
  actionAt,
  askedFrames,
  buildTape,
  describeFrame,
  landmarksAt,
  NO_LANDMARKS,
  sentLandmarks,
  stops,
  stretchAt,
} from './tape';

const box = (left: number) => ({ left, top: 0, right: 1, bottom: 1 });
const one = {
  subgoal: 'north',
  states: [
    [3, 1],
    [2, 1],
    [1, 1],
  ],
  actions: ['up', 'up'],
  frames: ['a', 'b', 'c'],
  landmarks: [{ north: box(0.1) }],
  action_landmarks: [],
};
const two = {
  subgoal: 'east',
  states: [
    [1, 1],
    [1, 2],
  ],
  actions: ['right'],
  frames: [],
  landmarks: [],
  action_landmarks: [],
};

describe('a tape', () => {
  const tape = buildTape([one], [two]);

  it('joins segments at the state they share', () => {
    expect(tape.frames).toEqual([
      [3, 1],
      [2, 1],
      [1, 1],
      [1, 2],
    ]);
    expect(tape.stretches.map(({ first, last, asked }) => [first, last, asked])).toEqual([
      [0, 2, false],
      [2, 3, true],
    ]);
    expect(tape.start).toBe(2);
  });

  it('knows the picture of each frame, where there is one', () => {
    expect(tape.pictures).toEqual(['a', 'b', 'c', null]);
  });

  it('knows the landmarks of each frame: sent for each state, once for all states, or not at all', () => {
    const right = { right: box(0.3) };
    const sent = { ...two, landmarks: [{}, { east: box(0.2) }], action_landmarks: [right] };
    const north = { subgoals: { north: box(0.1) }, actions: {} };
    const east = { subgoals: { east: box(0.2) }, actions: right };
    expect(buildTape([one], [sent]).landmarks).toEqual([north, north, north, east]);
    expect(tape.landmarks).toEqual([north, north, north, NO_LANDMARKS]);
  });

  it('sends landmarks on as they came, and none where there are none', () => {
    const sent = { landmarks: [{}, { east: box(0.2) }], action_landmarks: [] };
    expect(sentLandmarks([0, 1].map((state) => landmarksAt(sent, state)))).toEqual(sent);
  });

  it('does not join what does not meet', () => {
    const apart = buildTape(
      [],
      [
        one,
        {
          ...two,
          states: [
            [5, 5],
            [5, 6],
          ],
        },
      ],
    );
    expect(apart.frames).toHaveLength(5);
    expect(askedFrames(apart)).toEqual([0, 1, 3, 4]);
  });

  it('gives a shared state to the segment that begins there', () => {
    expect([0, 1, 2, 3].map((frame) => stretchAt(tape, frame)?.subgoal)).toEqual([
      'north',
      'north',
      'east',
      'east',
    ]);
    expect([0, 1, 2, 3].map((frame) => actionAt(tape, frame))).toEqual(['up', 'up', 'right', null]);
  });

  it('holds segments without actions', () => {
    const empty = buildTape(
      [],
      [
        { subgoal: 'west', states: [[1, 1]], actions: [], frames: [], landmarks: [], action_landmarks: [] },
        two,
      ],
    );
    expect(empty.frames).toHaveLength(2);
    expect(stops(empty)).toEqual([0, 1]);
  });

  it('says where one is', () => {
    expect(describeFrame(tape, 2)).toBe('step 2 of 3, action right, subgoal east');
    expect(describeFrame(tape, 3)).toBe('step 3 of 3, subgoal east');
  });

  it('asks about its own states only', () => {
    expect(askedFrames(tape)).toEqual([2, 3]);
  });
});

describe('the player', () => {
  const start = players.player(2, 10);

  it('stays on the tape', () => {
    expect(players.step(start, -5).at).toBe(0);
    expect(players.step(start, 99).at).toBe(10);
  });

  it('stops at the end, and plays again from where the question begins', () => {
    const ended = players.advance(players.toggle(start), 99);
    expect(ended).toMatchObject({ at: 10, playing: false });
    expect(players.toggle(ended)).toMatchObject({ at: 2, playing: true });
  });

  it('pauses where it is, and at every step taken by hand', () => {
    const playing = players.advance(players.toggle(start), 3);
    expect(players.toggle(playing)).toMatchObject({ at: 5, playing: false });
    expect(players.step(playing, 1)).toMatchObject({ at: 6, playing: false });
  });

  it('does not play what has one frame', () => {
    expect(players.toggle(players.player(0, 0)).playing).toBe(false);
  });

  it('jumps between the places where subgoals were decided', () => {
    const at = players.seek(start, 4);
    expect(players.jump(at, [0, 4, 7, 10], 1).at).toBe(7);
    expect(players.jump(at, [0, 4, 7, 10], -1).at).toBe(0);
    expect(players.jump(players.seek(at, 10), [0, 4, 10], 1).at).toBe(10);
  });

  it('has a slowest and a fastest speed', () => {
    expect(players.speedOf(players.changeSpeed(start, -9))).toBe(0.5);
    expect(players.speedOf(players.changeSpeed(start, 9))).toBe(4);
  });

  it('shows even a long trajectory quickly the first time', () => {
    const long = players.player(0, 100);
    expect(100 / players.framesPerSecond(long, true)).toBeLessThanOrEqual(1.6);
    expect(players.framesPerSecond(long, false)).toBe(10);
  });
});
