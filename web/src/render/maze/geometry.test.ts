import { describe, expect, it } from 'vitest';
import { describeCell, direction, isDoor, isLava, parseCell, parseMaze, type Maze } from './geometry';

const rows = Array.from({ length: 17 }, (_, row) =>
  Array.from({ length: 17 }, (_, column) => (row % 4 === 0 || column % 4 === 0 ? '#' : '.')).join(''),
);
rows[4] = '##..############'.replace('##..', '##.#') + '#'; // a door at row 4, column 2
const maze: Maze = { rows, start: [1, 1], goal: [15, 15] };

describe('a maze', () => {
  it('is read from its JSON, or not at all', () => {
    expect(parseMaze({ rows, start: [1, 1], goal: [15, 15] })).toEqual(maze);
    for (const bad of [
      null,
      'maze',
      [],
      {},
      { rows: [], start: [1, 1], goal: [1, 1] },
      { rows: [1], start: [1, 1], goal: [1, 1] },
      { rows, start: [1], goal: [1, 1] },
    ]) {
      expect(parseMaze(bad)).toBeNull();
    }
  });

  it('has cells of numbers', () => {
    expect(parseCell([3, 4])).toEqual([3, 4]);
    for (const bad of [null, 3, ['3', 4], { row: 1 }]) expect(parseCell(bad)).toBeNull();
  });

  it.each([
    [[1, 1], false, false, 'in room 1–1'],
    [[4, 2], false, true, 'in a door at row 4, column 2'],
    [[4, 1], true, false, 'in lava'],
    [[15, 15], false, false, 'on the target'],
    [[15, 3], false, false, 'in room 4–1'],
    [[99, 99], true, false, 'in lava'],
  ] as const)('knows what %j is', (cell, lava, door, words) => {
    expect(isLava(maze, cell)).toBe(lava);
    expect(isDoor(maze, cell)).toBe(door);
    expect(describeCell(maze, cell)).toBe(words);
  });

  it('tells the four ways apart, and standing still', () => {
    expect(direction([2, 2], [1, 2])).toEqual([-1, 0]);
    expect(direction([2, 2], [2, 3])).toEqual([0, 1]);
    expect(direction([2, 2], [2, 2])).toBeNull();
  });
});
