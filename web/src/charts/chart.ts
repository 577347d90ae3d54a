// A chart as plain values: marks, axes, paths and readings. Chart.svelte draws it as SVG; the download is the same SVG.
import { scaleLinear } from 'd3-scale';
import { area, curveLinear, curveStepAfter, line, type CurveFactory } from 'd3-shape';
import { t } from '../language/language';
import { SUBGOAL_COLORS } from '../ui/style/subgoals';

/** What distinguishes a series: its color and, for people who cannot see the color, its dashes and marker. */
export interface Mark {
  readonly color: string; // name of a custom property
  readonly dash: string; // a stroke-dasharray; '' for a solid line
  readonly marker: Marker;
}
export type Marker = 'circle' | 'square' | 'triangle' | 'diamond' | 'flag' | 'cross';

export interface Series {
  readonly label: string;
  readonly mark: Mark;
  readonly x: readonly number[]; // does not decrease
  readonly y: readonly (number | null)[]; // the values
  readonly top?: readonly number[]; // where the line is drawn, if not at `y`
  readonly low?: readonly number[]; // the lower edge of the filled area
  readonly high?: readonly number[]; // its upper edge
  readonly filled?: 'soft' | 'solid';
  readonly steps?: boolean; // each value holds until the next
}

/** A value that a curve is on its way to, and where on the x axis it is expected. */
export interface Goal {
  readonly y: number;
  readonly label: string;
  readonly span: Readonly<{ from: number; to: number; middle: number | null; label: string }> | null;
}

const DASHES = ['', '7 4', '2 3', '10 3 2 3', '5 2', '12 4', '1 4', '8 3 2 3 2 3'];
const MARKERS: readonly Marker[] = ['circle', 'square', 'triangle', 'diamond', 'flag', 'cross'];

/** Return the mark of the series with this number. There are eight colors, eight dashes and six shapes, so 24 marks differ. */
export function markOf(index: number): Mark {
  return {
    color: `subgoal-${index % SUBGOAL_COLORS}`,
    dash: DASHES[index % DASHES.length] ?? '',
    marker: MARKERS[index % MARKERS.length] ?? 'circle',
  };
}

/** Two ticks do not show whether an axis is even. */
const FEWEST = 3;

/** Maps a value to its position on the screen, in pixels. */
export type ToPixel = (value: number) => number;

/** Return the function that maps low..high onto from..to. */
export function scale(low: number, high: number, from: number, to: number): ToPixel {
  return scaleLinear([low, high > low ? high : low + 1], [from, to]);
}

/** Return about `count` round numbers from `low` to `high`, three or more if possible; `whole`: no fractions. */
export function ticks(low: number, high: number, count: number, whole = false): number[] {
  const ruler = scaleLinear([low, high], [0, 1]);
  const about = (wanted: number) => {
    const found = ruler.ticks(wanted);
    return whole ? found.filter(Number.isInteger) : found;
  };
  const finer = [count, 3, 4, 5].find((wanted) => about(wanted).length >= FEWEST);
  return about(finer ?? count);
}

/** Return the ranges of the axes: x from the smallest to the largest of all series and of the goal, y from 0 to the largest. */
export function extent(
  series: readonly Series[],
  goal: Goal | null = null,
): { x: [number, number]; y: number } {
  let [low, high, top] = [Infinity, goal?.span?.to ?? -Infinity, 0];
  for (const one of series) {
    low = Math.min(low, one.x[0] ?? Infinity);
    high = Math.max(high, one.x.at(-1) ?? -Infinity);
    for (const values of [one.top ?? one.y, one.high ?? []]) {
      for (const value of values) if (value !== null && value > top) top = value;
    }
  }
  return { x: low <= high ? [low, high] : [0, 1], y: top };
}

/** Return the rows to draw: in each column of pixels the first, the lowest, the highest and the last row. */
export function thinned(
  x: readonly number[],
  y: readonly (number | null)[],
  toPixel: ToPixel,
): readonly number[] {
  const all = Array.from(x, (_, row) => row);
  const columns = toPixel(x.at(-1) ?? 0) - toPixel(x[0] ?? 0);
  if (x.length <= 4 * Math.max(1, columns)) return all;
  const kept: number[] = [];
  for (const rows of groups(all, (row) => Math.round(toPixel(x[row] ?? 0)))) {
    const known = rows.filter((row) => typeof y[row] === 'number');
    const byValue = known.toSorted((a, b) => (y[a] ?? 0) - (y[b] ?? 0));
    const chosen = [rows[0], byValue[0], byValue.at(-1), rows.at(-1)].filter((row) => row !== undefined);
    kept.push(...[...new Set(chosen)].sort((a, b) => a - b));
  }
  return kept;
}

function groups(rows: readonly number[], key: (row: number) => number): number[][] {
  const found: number[][] = [];
  let last = NaN;
  for (const row of rows) {
    if (key(row) !== last) found.push([]);
    last = key(row);
    found.at(-1)?.push(row);
  }
  return found;
}

/** Return a series as the data of an SVG path; an unknown value breaks the line. */
export function linePath(
  series: Pick<Series, 'x' | 'steps'>,
  y: readonly (number | null)[],
  toX: ToPixel,
  toY: ToPixel,
): string {
  const path = line<number>()
    .defined((row) => typeof y[row] === 'number')
    .x((row) => toX(series.x[row] ?? 0))
    .y((row) => toY(y[row] ?? 0));
  return path.curve(curveOf(series)).digits(2)(thinned(series.x, y, toX)) ?? '';
}

/** Return the area between two lines as the data of an SVG path. */
export function areaPath(
  series: Pick<Series, 'x' | 'steps'>,
  low: readonly number[],
  high: readonly number[],
  toX: ToPixel,
  toY: ToPixel,
): string {
  const path = area<number>()
    .x((row) => toX(series.x[row] ?? 0))
    .y0((row) => toY(low[row] ?? 0))
    .y1((row) => toY(high[row] ?? 0));
  return path.curve(curveOf(series)).digits(2)(thinned(series.x, high, toX)) ?? '';
}

function curveOf({ steps }: Pick<Series, 'steps'>): CurveFactory {
  return steps ? curveStepAfter : curveLinear;
}

/** Return every x at which some series has a value, ascending. The arrow keys stop there. */
export function stopsOf(series: readonly Series[]): number[] {
  return [...new Set(series.flatMap((one) => one.x))].sort((a, b) => a - b);
}

/** Return the last row of a series at or before x; null before its first x and after its last. */
export function rowAt(series: Pick<Series, 'x'>, x: number): number | null {
  if (series.x.length === 0 || x > (series.x.at(-1) ?? x)) return null;
  let [low, high] = [0, series.x.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((series.x[middle] ?? Infinity) <= x) low = middle + 1;
    else high = middle;
  }
  return low === 0 ? null : low - 1;
}

/** Return the value of a series at x as text, with its range if it has one. */
export function readingOf(one: Series, x: number, format: (value: number) => string): string {
  const row = rowAt(one, x);
  const value = row === null ? null : one.y[row];
  if (row === null || value === null || value === undefined) return '–';
  if (one.filled !== 'soft') return format(value);
  const [low, high] = [one.low?.[row] ?? value, one.high?.[row] ?? value];
  return low === high ? format(value) : t(`${format(value)} (${format(low)} to ${format(high)})`);
}

/** Return the number of the stop nearest to x. */
export function nearest(stops: readonly number[], x: number): number {
  const at = rowAt({ x: [...stops, Infinity] }, x) ?? 0;
  const [before, after] = [stops[at] ?? x, stops[at + 1] ?? Infinity];
  return Math.min(x - before <= after - x ? at : at + 1, stops.length - 1);
}

/** Return places for labels, near `wanted` and at least `gap` apart, so that no label covers another. */
export function spread(wanted: readonly number[], gap: number, low: number, high: number): number[] {
  const order = wanted.map((_, index) => index).sort((a, b) => (wanted[a] ?? 0) - (wanted[b] ?? 0));
  const placed = new Array<number>(wanted.length).fill(0);
  let floor = low;
  for (const index of order) {
    placed[index] = Math.max(wanted[index] ?? 0, floor);
    floor = (placed[index] ?? 0) + gap;
  }
  let ceiling = high;
  for (const index of order.toReversed()) {
    placed[index] = Math.min(placed[index] ?? 0, ceiling);
    ceiling = (placed[index] ?? 0) - gap;
  }
  return placed;
}

/** A place for words, in pixels. */
export interface Place {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

/** Return the first place that no line passes; the first of all if lines pass each of them. */
export function freePlace<P extends Place>(
  places: readonly [P, ...P[]],
  series: readonly Series[],
  toX: ToPixel,
  toY: ToPixel,
): P {
  return places.find((place) => !series.some((one) => passes(one, place, toX, toY))) ?? places[0];
}

function passes(one: Series, { left, right, top, bottom }: Place, toX: ToPixel, toY: ToPixel): boolean {
  const across = one.x.map(toX);
  const [begin, end] = [across[0] ?? Infinity, across.at(-1) ?? -Infinity];
  if (begin > right || end < left) return false;
  const values = (one.top ?? one.y).map((value) => toY(value ?? 0));
  const line = scaleLinear(across, values);
  const inside = values.filter((_, row) => left <= (across[row] ?? 0) && (across[row] ?? 0) <= right);
  const heights = [line(Math.max(left, begin)), ...inside, line(Math.min(right, end))];
  return heights.some((y) => y >= top) && heights.some((y) => y <= bottom);
}

/** Return the few rows at which a line has its marker. They are at other places in each series. */
export function markerRows(series: Pick<Series, 'x'>, index: number, toX: ToPixel, every = 130): number[] {
  const rows: number[] = [];
  let next = toX(series.x[0] ?? 0) + every * (0.35 + 0.17 * (index % 5));
  series.x.forEach((x, row) => {
    if (toX(x) < next) return;
    rows.push(row);
    next = toX(x) + every;
  });
  return rows;
}

const SHAPES: Readonly<Record<Marker, string>> = {
  circle: 'M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0Z',
  square: 'M-3.5 -3.5H3.5V3.5H-3.5Z',
  triangle: 'M0 -4.5L4.5 3.5H-4.5Z',
  diamond: 'M0 -5L5 0L0 5L-5 0Z',
  flag: 'M0 4.5L4.5 -3.5H-4.5Z',
  cross: 'M-4 -1.3H-1.3V-4H1.3V-1.3H4V1.3H1.3V4H-1.3V1.3H-4Z',
};

export function shapeOf(marker: Marker): string {
  return SHAPES[marker];
}

/** Return at most `most` rows, evenly spread; the last row is always one of them. */
export function sampleRows(length: number, most: number): number[] {
  if (length <= most) return Array.from({ length }, (_, row) => row);
  const stride = (length - 1) / (most - 1);
  return Array.from({ length: most }, (_, index) => Math.round(index * stride));
}
