import { describe, expect, it } from 'vitest';
import {
  areaPath,
  extent,
  freePlace,
  linePath,
  markOf,
  nearest,
  rowAt,
  sampleRows,
  scale,
  spread,
  stopsOf,
  thinned,
  ticks,
  type Series,
} from './chart';
import { toCsv } from './csv';

const same = (value: number): number => value;

describe('axes', () => {
  it.each([
    [0, 1, 5, [0, 0.2, 0.4, 0.6, 0.8, 1]],
    [0, 500, 5, [0, 100, 200, 300, 400, 500]],
    [3, 17, 4, [5, 10, 15]],
    [0, 0.07, 5, [0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07]],
    [0, 0.08, 4, [0, 0.02, 0.04, 0.06, 0.08]],
    [7, 7, 5, [7]],
  ])('from %f to %f have round ticks', (low, high, count, expected) => {
    expect(ticks(low, high, count)).toEqual(expected);
  });

  it.each([3, 4, 5, 6])('have enough ticks wherever they end: 0 to 999 in about %i', (count) => {
    const found = ticks(0, 999, count).length;
    expect(found).toBeGreaterThanOrEqual(count - 1);
    expect(found).toBeLessThanOrEqual(2 * count);
  });

  it.each([
    [0, 999, 2, false],
    [0, 999, 3, false],
    [0, 1, 2, false],
    [0, 0.4, 1, false],
    [0, 3, 2, true],
    [7, 9, 1, true],
    [0, 190, 2, true],
  ])('have three ticks or more, so that one sees how even they are: %f to %f', (low, high, count, whole) => {
    expect(ticks(low, high, count, whole).length).toBeGreaterThanOrEqual(3);
    expect(ticks(low, high, count, whole).length).toBeLessThanOrEqual(6);
  });

  it('have no more ticks than there are whole numbers', () => {
    expect(ticks(0, 1, 5, true)).toEqual([0, 1]);
    expect(ticks(4, 4, 5, true)).toEqual([4]);
  });

  it('of episodes have no half ones', () => {
    expect(ticks(0, 2, 6, true)).toEqual([0, 1, 2]);
  });

  it('hold all that is drawn', () => {
    const mark = markOf(0);
    const series: Series[] = [
      { label: 'a', mark, x: [1, 5], y: [2, null] },
      { label: 'b', mark, x: [0, 3], y: [1, 1], low: [0, 0], high: [1, 9] },
      { label: 'none yet', mark, x: [], y: [] },
    ];
    expect(extent(series)).toEqual({ x: [0, 5], y: 9 });
    expect(extent([])).toEqual({ x: [0, 1], y: 0 });
  });

  it('map a range onto pixels, a single value too', () => {
    expect([0, 5, 10].map(scale(0, 10, 100, 200))).toEqual([100, 150, 200]);
    expect(scale(3, 3, 100, 200)(3)).toBe(100);
  });
});

describe('lines', () => {
  it('break where nothing is known', () => {
    expect(linePath({ x: [0, 1, 2, 3] }, [1, null, 2, 3], same, same)).toBe('M0,1ZM2,2L3,3');
  });

  it('hold each value until the next where they are steps', () => {
    const series = { x: [0, 2], steps: true };
    expect(linePath(series, [1, 3], same, same)).toBe('M0,1L2,1L2,3');
    expect(areaPath(series, [0, 0], [1, 3], same, same)).toBe('M0,1L2,1L2,3L2,0L2,0L0,0Z');
  });

  it('keep their peaks where many rows fall on a pixel', () => {
    const x = Array.from({ length: 10_000 }, (_, row) => row);
    const y = x.map((row) => (row === 4_321 ? 99 : 1));
    const rows = thinned(x, y, scale(0, 9_999, 0, 100));
    expect(rows.length).toBeLessThan(500);
    expect(rows).toContain(4_321);
    expect(rows).toEqual([...new Set(rows)].sort((a, b) => a - b));
    expect(thinned([1, 2], [1, 2], same)).toEqual([0, 1]);
  });

  it('are told apart without color', () => {
    const marks = Array.from({ length: 24 }, (_, index) => markOf(index));
    expect(new Set(marks.map(({ dash, marker }) => dash + marker)).size).toBe(24);
  });
});

describe('reading values', () => {
  it('stops wherever a series has one', () => {
    const mark = markOf(0);
    expect(
      stopsOf([
        { label: 'a', mark, x: [0, 2], y: [1, 1] },
        { label: 'b', mark, x: [1, 2], y: [1, 1] },
      ]),
    ).toEqual([0, 1, 2]);
  });

  it('takes the row that holds there, the last of several at one place', () => {
    const series = { x: [1, 3, 3, 8] };
    expect([0, 1, 2, 3, 7, 8, 9].map((x) => rowAt(series, x))).toEqual([null, 0, 0, 2, 2, 3, null]);
  });

  it('goes to the stop nearest to the pointer', () => {
    expect([-5, 1, 4, 6, 99].map((x) => nearest([0, 4, 8], x))).toEqual([0, 0, 1, 1, 2]);
  });

  it('has a table short enough to read', () => {
    expect(sampleRows(3, 5)).toEqual([0, 1, 2]);
    expect(sampleRows(101, 5)).toEqual([0, 25, 50, 75, 100]);
    expect(sampleRows(0, 5)).toEqual([]);
  });

  it('writes no label over another', () => {
    expect(spread([50, 52, 10], 14, 0, 100)).toEqual([50, 64, 10]);
    expect(spread([99, 98, 97], 14, 0, 100)).toEqual([100, 86, 72]);
  });
});

describe('CSV', () => {
  it('quotes what must be quoted and carries no formula', () => {
    expect(
      toCsv([
        ['a,b', 'say "x"', null],
        ['=1+1', -2, '@x'],
      ]),
    ).toBe('"a,b","say ""x""",\r\n\'=1+1,-2,\'@x\r\n');
  });
});

describe('the place of words', () => {
  const place = (left: number, top: number) => ({ left, right: left + 2, top, bottom: top + 2 });
  const rising = { label: 'a', mark: markOf(0), x: [0, 10], y: [0, 10] };

  it('is the first that no line passes', () => {
    expect(freePlace([place(4, 4), place(4, 8), place(8, 0)], [rising], same, same)).toEqual(place(4, 8));
    expect(freePlace([place(4, 4), place(8, 8)], [rising], same, same)).toEqual(place(4, 4));
  });

  it('is where no line has begun or goes on', () => {
    expect(freePlace([place(11, 9)], [rising], same, same)).toEqual(place(11, 9));
    const late = { ...rising, x: [8, 10] };
    expect(freePlace([place(0, 0), place(4, 4)], [late], same, same)).toEqual(place(0, 0));
  });
});
