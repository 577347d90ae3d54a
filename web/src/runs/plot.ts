// Loaded when a chart is shown, so that the work view does not pay for it.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { readColor } from '../ui/colors';

export interface Series {
  readonly color: string; // name of a custom property
  readonly values: readonly (number | null)[];
  readonly filled: boolean;
}

export interface Plot {
  readonly x: readonly number[];
  readonly series: readonly Series[];
  readonly most: number | null; // top of the y axis; null: as the data have it
  readonly format: (value: number) => string;
  readonly hover: (row: number | null) => void;
}

export interface Drawn {
  resize(width: number, height: number): void;
  destroy(): void;
}

export function drawPlot(element: HTMLElement, plot: Plot, width: number, height: number): Drawn {
  const data: uPlot.AlignedData = [[...plot.x], ...plot.series.map((series) => [...series.values])];
  const drawn = new uPlot(options(element, plot, width, height), data, element);
  return { resize: (w, h) => drawn.setSize({ width: w, height: h }), destroy: () => drawn.destroy() };
}

function options(element: HTMLElement, plot: Plot, width: number, height: number): uPlot.Options {
  const stroke = readColor(element, 'var(--muted)');
  const grid = { stroke: readColor(element, 'var(--line)'), width: 1 };
  const axis: uPlot.Axis = { stroke, grid, ticks: { show: false }, font: '12px system-ui' };
  const values: uPlot.Axis['values'] = (_, ticks) => ticks.map((tick) => plot.format(tick));
  return {
    width,
    height,
    legend: { show: false },
    cursor: { y: false, drag: { x: false, y: false } },
    scales: { x: { time: false }, y: { range: (_, __, top) => [0, plot.most ?? Math.max(1, top * 1.05)] } },
    axes: [
      { ...axis, size: 28 },
      { ...axis, size: 56, values },
    ],
    series: [{}, ...plot.series.map((series) => seriesOf(element, series, plot.x.length))],
    hooks: { setCursor: [(self) => plot.hover(self.cursor.idx ?? null)] },
  };
}

function seriesOf(element: HTMLElement, series: Series, length: number): uPlot.Series {
  const color = readColor(element, `var(--${series.color})`);
  const points = { show: length < 2 };
  if (!series.filled) return { stroke: color, width: 2, points };
  const fill = readColor(element, `color-mix(in srgb, var(--${series.color}) 62%, var(--surface))`);
  return { stroke: color, fill, width: 1.5, points };
}
