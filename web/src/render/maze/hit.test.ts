import { describe, expect, it } from 'vitest';
import { buildTape } from '../../player/tape';
import type { Maze } from './geometry';
import { cellAt, cellBeside, frameAt, isOn, placeAt, placesOf, reachOf } from './hit';

const maze: Maze = {
  rows: [
    '#########',
    '#...#...#',
    '#.......#',
    '#...#...#',
    '##.######',
    '#...#...#',
    '#.......#',
    '#...#...#',
    '#########',
  ],
  start: [7, 1],
  goal: [1, 7],
};
const SUBGOALS = ['north', 'south', 'west', 'east', 'go_to_target', 'dance'];
const tapeOf = (...states: number[][]): ReturnType<typeof buildTape> =>
  buildTape(
    [],
    [
      {
        subgoal: 'north',
        states,
        actions: states.slice(1).map(() => 'up'),
        frames: [],
        landmarks: [],
        action_landmarks: [],
      },
    ],
  );

describe('the cells beside the agent', () => {
  it('are free, and may be hit a little beside', () => {
    expect(cellBeside(maze, [7, 1], [6.5, 1.5], 0.5)).toEqual([6, 1]);
    expect(cellBeside(maze, [7, 1], [6.5, 0.9], 0.8)).toEqual([6, 1]);
    expect(cellBeside(maze, [7, 1], [8.5, 1.5], 0.5)).toBeNull(); // lava
    expect(cellBeside(maze, [7, 1], [5.5, 1.5], 0.5)).toBeNull(); // two steps away
  });
  it('are not the cell of the agent', () => {
    expect(isOn([7, 1], [7.2, 1.9], 0.5)).toBe(true);
    expect(isOn([7, 1], [6.9, 1.5], 0.5)).toBe(false);
  });
});

describe('the places of subgoals', () => {
  it('are the doors of the room for its sides, and the target', () => {
    expect(placesOf(maze, [7, 1], SUBGOALS)).toEqual([
      { subgoal: 'north', cell: [4, 2] },
      { subgoal: 'east', cell: [6, 4] },
      { subgoal: 'go_to_target', cell: [1, 7] },
    ]);
    expect(placesOf(maze, [1, 3], SUBGOALS).map(({ subgoal }) => subgoal)).toEqual([
      'south',
      'east',
      'go_to_target',
    ]);
  });

  it('are the cells beside a door', () => {
    expect(placesOf(maze, [4, 2], ['north', 'south', 'east'])).toEqual([
      { subgoal: 'north', cell: [3, 2] },
      { subgoal: 'south', cell: [5, 2] },
    ]);
  });

  it('are hit within their reach, the nearest first', () => {
    const places = placesOf(maze, [7, 1], SUBGOALS);
    expect(placeAt(places, [4.5, 2.5], 0.5)?.subgoal).toBe('north');
    expect(placeAt(places, [4.5, 1.9], 0.5)).toBeNull();
    expect(placeAt(places, [4.5, 1.9], 0.7)?.subgoal).toBe('north');
    expect(placeAt(places, [4.5, 2.6], 9)?.subgoal).toBe('north');
    expect(placeAt([], [4.5, 2.5], 9)).toBeNull();
  });
});

describe('a frame', () => {
  it('is found by its cell, or by a point near it', () => {
    const tape = tapeOf([7, 1], [6, 1], [5, 1]);
    expect(frameAt(tape, 0, [6.2, 1.9], 0.5)).toBe(1);
    expect(frameAt(tape, 0, [5.5, 2.1], 0.5)).toBeNull();
    expect(frameAt(tape, 0, [5.5, 2.1], 0.7)).toBe(2);
    expect(frameAt(tape, 0, [1.5, 6.5], 0.7)).toBeNull();
  });

  it('is the next visit of the cell, and after the last one the first again', () => {
    const tape = tapeOf([7, 1], [6, 1], [7, 1], [6, 1], [7, 1]);
    expect([0, 2, 4].map((at) => frameAt(tape, at, [7.5, 1.5], 0.5))).toEqual([2, 4, 0]);
  });
});

describe('a target', () => {
  it.each([
    [21, 12 / 21],
    [12, 1],
    [40, 0.5],
  ])('is at least 24 pixels wide where cells are %d', (unit, reach) =>
    expect(reachOf(unit)).toBeCloseTo(reach),
  );

  it('is in the cell of its point', () => expect(cellAt([3.99, 0.01])).toEqual([3, 0]));
});
