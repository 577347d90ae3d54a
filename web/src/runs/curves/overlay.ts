// Several runs in one chart: groups that differ only by seed, their median and range.
import type { Curves, Run } from '../../api/types';
import { settingsOf } from '../../api/configuration';
import { t } from '../../language/language';
import { X_AXES, type XAxisName } from './curves';

/** Runs that differ only by seed. */
export interface Group {
  readonly key: string;
  readonly label: string;
  readonly runs: readonly Run[];
}

/** Group runs that differ only by seed, in their order; with `apart`, each run is a group. */
export function grouped(runs: readonly Run[], apart: boolean): Group[] {
  const groups = new Map<string, Run[]>();
  for (const run of runs) {
    const key = apart ? run.id : sameBut(run);
    groups.set(key, [...(groups.get(key) ?? []), run]);
  }
  const facts = new Map([...groups].map(([key, members]) => [key, factsOf(members[0])]));
  const names = new Map([...groups].map(([key, members]) => [key, nameOf(key, members)]));
  return [...groups].map(([key, members]) => {
    const name = names.get(key) ?? '';
    const twins = [...names].filter(([, other]) => other === name).map(([other]) => other);
    const unique = twins.length < 2 ? '' : ` ${members[0]?.id.slice(0, 4) ?? ''}`;
    const own = `${name}${unique}`;
    return { key, label: members.length > 1 ? t(`${own} (${members.length} runs)`) : own, runs: members };
  });

  /** Return a run's own name; for several runs, the algorithm and the facts that differ from other groups. */
  function nameOf(key: string, members: readonly Run[]): string {
    const [first] = members;
    if (first === undefined) return '';
    if (members.length === 1) return first.name;
    const own = facts.get(key) ?? new Map<string, string>();
    const differing = [...own].filter(([fact, value]) =>
      [...facts.values()].some(
        (other) => other.get('algorithm') === first.algorithm && other.get(fact) !== value,
      ),
    );
    return [first.algorithm, ...differing.map(([fact, value]) => `${fact} ${value}`)].join(', ');
  }
}

function factsOf(run: Run | undefined): Map<string, string> {
  if (run === undefined) return new Map();
  const facts = new Map(settingsOf(run)).set('algorithm', run.algorithm).set('domain', run.vocabulary.domain);
  facts.delete('seed');
  return facts;
}

function sameBut(run: Run): string {
  return JSON.stringify([[...factsOf(run)].sort(), run.prices, run.episodes]);
}

/** One run's values over an x axis. If the run is `over`, it keeps its last value. */
export interface Track {
  readonly x: readonly number[];
  readonly y: readonly number[];
  readonly over: boolean;
}

export function trackOf(
  run: Run,
  curves: Curves,
  xAxis: XAxisName,
  values: readonly (number | null)[],
): Track {
  const all = X_AXES[xAxis].of(curves);
  const rows = values.flatMap((value, row) => (value === null ? [] : [row]));
  return {
    x: rows.map((row) => all[row] ?? 0),
    y: rows.map((row) => values[row] ?? 0),
    over: run.state === 'finished',
  };
}

const POINTS = 201;

export interface Band {
  readonly x: number[];
  readonly median: number[];
  readonly low: number[];
  readonly high: number[];
}

/**
 * Return the median and range of runs, each a step function, on one grid. The grid begins where all runs have begun and
 * ends where half of them have ended. After its end, a finished run keeps its last value; an unfinished run is left out.
 */
export function bandOf(tracks: readonly Track[]): Band | null {
  const begun = tracks.filter((track) => track.x.length > 0);
  if (begun.length === 0) return null;
  const start = Math.max(...begun.map((track) => track.x[0] ?? 0));
  const ends = begun.map((track) => track.x.at(-1) ?? 0).sort((a, b) => a - b);
  const end = Math.max(start, ends[ends.length >> 1] ?? 0);
  const rows = begun
    .flatMap((track) => track.x)
    .map((x) => Math.min(Math.max(x, start), end))
    .sort((a, b) => a - b);
  const picked = Array.from(
    { length: POINTS },
    (_, index) => rows[Math.round((index / (POINTS - 1)) * (rows.length - 1))] ?? end,
  );
  const grid = [...new Set([start, ...picked, end])];
  const band: Band = { x: [], median: [], low: [], high: [] };
  const places = begun.map(() => 0);
  for (const x of grid) {
    const values = begun.flatMap((track, index) => {
      let place = places[index] ?? 0;
      while ((track.x[place + 1] ?? Infinity) <= x) place++;
      places[index] = place;
      const known = track.over || x <= (track.x.at(-1) ?? x);
      return known && (track.x[place] ?? Infinity) <= x ? [track.y[place] ?? 0] : [];
    });
    if (values.length === 0) continue;
    band.x.push(x);
    band.median.push(median(values));
    band.low.push(Math.min(...values));
    band.high.push(Math.max(...values));
  }
  return band;
}

export function median(values: readonly number[]): number {
  const sorted = values.toSorted((a, b) => a - b);
  const middle = sorted.length >> 1;
  const upper = sorted[middle] ?? NaN;
  return sorted.length % 2 === 1 ? upper : ((sorted[middle - 1] ?? NaN) + upper) / 2;
}
