import { describe, expect, it } from 'vitest';
import { buildTape, type Tape } from '../../player/tape';
import type { Cell, Maze } from './geometry';
import { actionsAlong, actionsTo, endOf, extended, subgoalsAlong, type Stroke } from './stroke';

/** Two by two rooms of three by three cells. */
const maze: Maze = {
  rows: [
    '#########', // 0
    '#...#...#',
    '#.......#', // 2: a door at column 4
    '#...#...#',
    '##.######', // 4: a door at column 2
    '#...#...#',
    '#.......#', // 6: a door at column 4
    '#...#...#',
    '#########', // 8
  ],
  start: [7, 1],
  goal: [1, 7],
};
const drawn = (...cells: Cell[]): Stroke =>
  cells.reduce<Stroke>((stroke, cell) => extended(maze, stroke, cell), []);

const MOVES: Readonly<Record<string, Cell>> = { u: [-1, 0], d: [1, 0], l: [0, -1], r: [0, 1] };
const NAMES: Readonly<Record<string, string>> = { u: 'up', d: 'down', l: 'left', r: 'right' };

/** A trajectory of segments, such as ['north', 'uu'], from a cell; the first `before` of them are only shown. */
function walked(start: Cell, segments: readonly (readonly [string, string])[], before = 0): Tape {
  let [row, column] = start;
  const all = segments.map(([subgoal, moves]) => {
    const states = [[row, column]];
    for (const move of moves) {
      [row, column] = [row + (MOVES[move]?.[0] ?? 0), column + (MOVES[move]?.[1] ?? 0)];
      states.push([row, column]);
    }
    return {
      subgoal,
      states,
      actions: Array.from(moves, (move) => NAMES[move] ?? ''),
      frames: [],
      landmarks: [],
      action_landmarks: [],
    };
  });
  return buildTape(all.slice(0, before), all.slice(before));
}

describe('the way of an agent that follows the pointer', () => {
  it('is straight, or around one corner', () => {
    expect(actionsTo(maze, [7, 1], [5, 1])).toEqual(['up', 'up']);
    expect(actionsTo(maze, [7, 3], [4, 2])).toEqual(['left', 'up', 'up', 'up']); // first up, it would meet lava
    expect(actionsTo(maze, [6, 3], [7, 1])).toEqual(['down', 'left', 'left']);
    expect(actionsTo(maze, [7, 1], [7, 1])).toEqual([]);
  });
  it('never leads through lava', () => {
    expect(actionsTo(maze, [7, 1], [7, 5])).toEqual([]);
    expect(actionsTo(maze, [7, 1], [8, 1])).toEqual([]);
  });
});

describe('a stroke', () => {
  it('passes every cell between two that the pointer was seen on', () => {
    expect(drawn([7, 1], [5, 1])).toEqual([
      [7, 1],
      [6, 1],
      [5, 1],
    ]);
    expect(drawn([7, 1], [7, 1])).toEqual([[7, 1]]);
  });

  it('turns at the corner that is free of lava', () => {
    expect(drawn([5, 2], [3, 3])).toEqual([
      [5, 2],
      [4, 2],
      [3, 2],
      [3, 3],
    ]); // not through the wall at (4, 3)
    expect(drawn([3, 3], [5, 2])).toEqual([
      [3, 3],
      [3, 2],
      [4, 2],
      [5, 2],
    ]);
  });

  it('does not begin in lava, and waits where the pointer is in lava', () => {
    expect(drawn([0, 0])).toEqual([]);
    expect(drawn([5, 1], [4, 1], [3, 1])).toEqual([[5, 1]]);
    expect(drawn([5, 1], [4, 1], [5, 2])).toEqual([
      [5, 1],
      [5, 2],
    ]);
    expect(drawn([1, 1], [-3, 1], [1, 99])).toEqual([[1, 1]]); // outside of the map
  });

  it('gets shorter on its way back', () => {
    expect(drawn([7, 1], [5, 1], [6, 1])).toEqual([
      [7, 1],
      [6, 1],
    ]);
    expect(drawn([7, 1], [5, 1], [7, 1])).toEqual([[7, 1]]);
  });
});

describe('the actions along a stroke', () => {
  const tape = walked([7, 1], [['north', 'uurrr']]); // it walks past the door

  it('are those that leave the states on it', () => {
    const stroke = drawn([7, 1], [5, 1], [5, 2], [3, 2]);
    expect(actionsAlong(stroke, tape)).toEqual([
      { frame: 0, name: 'up' },
      { frame: 1, name: 'up' },
      { frame: 2, name: 'right' },
      { frame: 3, name: 'up' },
    ]);
  });

  it('need no label where the learner never was, and none in the last state', () => {
    expect(actionsAlong(drawn([1, 1], [1, 3]), tape)).toEqual([]);
    expect(actionsAlong(drawn([5, 4], [5, 2]), tape)).toEqual([]); // lava is no beginning
    expect(actionsAlong(drawn([6, 4], [6, 3]), walked([6, 2], [['east', 'rr']]))).toEqual([]);
  });

  it('are the same at every visit of a cell, and the last way out of it counts', () => {
    const back = walked([7, 1], [['north', 'uduu']]);
    expect(actionsAlong(drawn([7, 1], [5, 1]), back).map(({ frame, name }) => `${frame} ${name}`)).toEqual([
      '0 up',
      '1 up',
      '2 up',
      '3 up',
    ]);
    const around = drawn([7, 1], [7, 2], [6, 2], [6, 1], [7, 1], [7, 2]);
    const loop = [...around.slice(0, -1), [7, 1], [7, 2], [7, 3]] as Stroke;
    expect(actionsAlong(loop, walked([7, 2], [['east', 'r']]))).toEqual([{ frame: 0, name: 'right' }]);
  });

  it('skip the segments that the query does not ask about', () => {
    const two = walked(
      [7, 1],
      [
        ['north', 'u'],
        ['north', 'u'],
      ],
      1,
    );
    expect(actionsAlong(drawn([7, 1], [5, 1]), two)).toEqual([{ frame: 1, name: 'up' }]);
  });

  it('lead to the asked state where the stroke ends, if there is one after them', () => {
    const way = drawn([7, 1], [5, 1]);
    expect(endOf(way, tape, actionsAlong(way, tape))).toBe(2);
    const away = drawn([7, 1], [7, 3]);
    expect(endOf(away, tape, actionsAlong(away, tape))).toBeNull();
    const back = drawn([5, 1], [7, 1]);
    expect(endOf(back, tape, actionsAlong(back, tape))).toBeNull(); // it was there only before
  });
});

describe('the subgoals along a stroke', () => {
  const tape = walked(
    [7, 1],
    [
      ['north', 'uuruu'],
      ['north', 'uu'],
      ['east', 'r'],
      ['east', 'rrr'],
    ],
  );

  it('are the sides where it leaves the rooms in which segments begin, and the target where it reaches it', () => {
    const stroke = drawn([7, 1], [5, 1], [5, 2], [2, 2], [2, 7], [1, 7]);
    expect(subgoalsAlong(stroke, tape, maze)).toEqual([
      { frame: 0, name: 'north' },
      { frame: 5, name: 'east' },
      { frame: 7, name: 'east' },
      { frame: 8, name: 'east' },
    ]);
    const inside = walked([3, 7], [['west', 'u']]);
    expect(subgoalsAlong(drawn([3, 7], [1, 7]), inside, maze)).toEqual([{ frame: 0, name: 'go_to_target' }]);
    expect(subgoalsAlong(drawn([3, 7], [2, 7]), inside, maze)).toEqual([]);
  });

  it('are none for rooms that it does not leave or pass', () => {
    expect(subgoalsAlong(drawn([7, 1], [5, 1]), tape, maze)).toEqual([]);
    expect(subgoalsAlong(drawn([6, 5], [7, 5]), tape, maze)).toEqual([]);
  });

  it('may begin in a door', () => {
    const indoors = walked([4, 2], [['south', 'd']]);
    expect(subgoalsAlong(drawn([4, 2], [3, 2]), indoors, maze)).toEqual([{ frame: 0, name: 'north' }]);
  });
});
