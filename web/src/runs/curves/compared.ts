// Several runs side by side: what each cost and reached, and the median and range of those that differ only by seed.
import type { Costs, Curves, Run } from '../../api/types';
import type { Target } from './forecast';
import { median } from './overlay';

/** A run as it is compared. */
export interface Compared {
  readonly run: Run;
  readonly curves: Curves;
  readonly costs: Costs;
}

/** The median of some runs and their range. Infinity stands for what was not reached. */
export interface Spread {
  readonly median: number;
  readonly low: number;
  readonly high: number;
}

/** Return the median (NaN for no values) and range. What is null was not reached, so it is more than any number. */
export function spreadOf(values: readonly (number | null)[]): Spread {
  const all = values.map((value) => value ?? Infinity);
  return { median: median(all), low: Math.min(...all), high: Math.max(...all) };
}

/** Return the units after which a run first reached a level of success; null if it did not. */
export function unitsTo(level: Target, { costs }: Compared): number | null {
  return costs.first_at[level]?.cost ?? null;
}
