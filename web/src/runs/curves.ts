import type { Curves, Kind, Run } from '../api/types';
import { KIND_NAMES } from '../api/types';
import { markOf, type Series } from '../charts/chart';
import { number, seconds } from '../ui/format';

/** In the order of the paper's algorithm, from the bottom of the stack up. */
export const KINDS: readonly Kind[] = [
  'hier_demo',
  'inspect_full',
  'label_hi',
  'inspect_lo',
  'label_lo',
  'label_full',
];
/** The same color for a kind wherever it is drawn. */
const KIND_MARKS: Readonly<Record<Kind, number>> = {
  hier_demo: 5,
  inspect_full: 4,
  label_hi: 2,
  inspect_lo: 3,
  label_lo: 1,
  label_full: 0,
};

/** What a curve can be drawn against. */
export interface Across {
  readonly name: string; // of the axis
  readonly short: string;
  readonly of: (curves: Curves) => readonly number[];
  readonly format: (value: number) => string;
}
export type AcrossName = 'episode' | 'cost' | 'lo-cost' | 'seconds';
export const ACROSS: Readonly<Record<AcrossName, Across>> = {
  episode: { name: 'episode', short: 'Episodes', of: (curves) => curves.episode, format: number },
  cost: { name: 'total cost, units', short: 'Total cost', of: (curves) => curves.cost, format: number },
  'lo-cost': { name: 'LO cost, units', short: 'LO cost', of: (curves) => curves.lo_cost, format: number },
  seconds: {
    name: 'annotators’ time',
    short: 'Annotators’ time',
    of: (curves) => curves.seconds,
    format: seconds,
  },
};

export function acrossOf(name: string | null): AcrossName {
  return name !== null && Object.hasOwn(ACROSS, name) ? (name as AcrossName) : 'episode';
}

/** Success against an axis. Against anything but episodes it is a step: what was reached for what was spent. */
export function successOf(curves: Curves, across: AcrossName): Series[] {
  const x = ACROSS[across].of(curves);
  if (!curves.success_rate.some((rate) => rate !== null)) return [];
  return [
    {
      label: 'Success',
      mark: { color: 'accent', dash: '', marker: 'circle' },
      x,
      y: curves.success_rate,
      steps: across !== 'episode',
    },
  ];
}

/** Cumulative cost by kind, one on the other: only kinds that ever cost something, the highest layer first. */
export function stackOf(curves: Curves, across: AcrossName): Series[] {
  const x = ACROSS[across].of(curves);
  let below: readonly number[] = x.map(() => 0);
  const layers: Series[] = [];
  for (const kind of KINDS) {
    const own = curves.cost_by_kind[kind] ?? [];
    if (!own.some((units) => units > 0)) continue;
    const low = below;
    const high = own.map((units, row) => units + (low[row] ?? 0));
    const mark = { ...markOf(KIND_MARKS[kind]), dash: '' };
    layers.push({ label: KIND_NAMES[kind], mark, x, y: own, top: high, low, high, filled: 'solid' });
    below = high;
  }
  return layers.reverse();
}

/** What is known of a run and what came after it. */
export function joined(known: Curves | null, more: Curves): Curves {
  if (known === null || known.episode.length === 0) return more;
  if (more.episode.length === 0) return known;
  const kinds = KINDS.map((kind) => [
    kind,
    [...(known.cost_by_kind[kind] ?? []), ...(more.cost_by_kind[kind] ?? [])],
  ]);
  return {
    episode: [...known.episode, ...more.episode],
    success_rate: [...known.success_rate, ...more.success_rate],
    test_success: [...known.test_success, ...more.test_success],
    cost: [...known.cost, ...more.cost],
    lo_cost: [...known.lo_cost, ...more.lo_cost],
    seconds: [...known.seconds, ...more.seconds],
    active_seconds: [...known.active_seconds, ...more.active_seconds],
    cost_by_kind: Object.fromEntries(kinds),
    hi_labels: [...known.hi_labels, ...more.hi_labels],
    lo_samples: [...known.lo_samples, ...more.lo_samples],
    learner_seconds: [...known.learner_seconds, ...more.learner_seconds],
  };
}

// --- several runs -----------------------------------------------------------------------------------------------------

/** Runs that differ only by seed. */
export interface Group {
  readonly key: string;
  readonly label: string;
  readonly runs: readonly Run[];
}

/** Put runs that differ only by seed together, in the order they come; `apart`: each alone. */
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
    const size = members.length > 1 ? ` (${members.length} runs)` : '';
    return { key, label: `${name}${unique}${size}`, runs: members };
  });

  /** One run goes by its name; several by their algorithm and what sets them apart from the other groups. */
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
  const { seed: _, ...config } = run.config;
  const facts = { ...config, algorithm: run.algorithm, domain: run.vocabulary.domain };
  return new Map(
    Object.entries(facts).map(([name, value]) => [
      name,
      typeof value === 'string' ? value : JSON.stringify(value),
    ]),
  );
}

function sameBut(run: Run): string {
  return JSON.stringify([[...factsOf(run)].sort(), run.prices, run.episodes]);
}

/** One run against an axis; of one that is `over`, the last value holds for good. */
export interface Track {
  readonly x: readonly number[];
  readonly y: readonly number[];
  readonly over: boolean;
}

export function trackOf(
  run: Run,
  curves: Curves,
  across: AcrossName,
  values: readonly (number | null)[],
): Track {
  const all = ACROSS[across].of(curves);
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
 * The median and range of runs, each a step function, on one grid: from where all have begun to as far as half of them
 * went. A finished run that ended before keeps its last value; an unfinished one is left out from its end on.
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
