// The learning curves of one run: loaded, and as series of a chart.
import { api, unwrap } from '../../api/client';
import { KIND_NAMES } from '../../api/names';
import { KINDS, type Curves, type Kind } from '../../api/types';
import { markOf, type Series } from '../../charts/chart';
import { t } from '../../language/language';
import { number, seconds } from '../../ui/format';

/** The mark of each kind, the same in every chart. */
const KIND_MARKS: Readonly<Record<Kind, number>> = {
  hier_demo: 5,
  inspect_full: 4,
  label_hi: 2,
  inspect_lo: 3,
  label_lo: 1,
  label_full: 0,
};

/** Success is the share of so many tests, the last ones; with fewer tests, no level of it counts as reached. */
export const WINDOW = 100;

/** A quantity for the x axis. */
export interface XAxis {
  readonly of: (curves: Curves) => readonly number[];
  readonly format: (value: number) => string;
}
export type XAxisName = 'episode' | 'cost' | 'lo-cost' | 'seconds';
export const X_AXES: Readonly<Record<XAxisName, XAxis>> = {
  episode: { of: (curves) => curves.episode, format: number },
  cost: { of: (curves) => curves.cost, format: number },
  'lo-cost': { of: (curves) => curves.lo_cost, format: number },
  seconds: { of: (curves) => curves.seconds, format: seconds },
};

/** Return what a quantity is called: at its axis, and where it is chosen. */
export function namesOfAxis(name: XAxisName): Readonly<Record<'axis' | 'choice', string>> {
  switch (name) {
    case 'episode':
      return { axis: t('episode'), choice: t('Episodes') };
    case 'cost':
      return { axis: t('total cost, units'), choice: t('Total cost') };
    case 'lo-cost':
      return { axis: t('LO cost, units'), choice: t('LO cost') };
    case 'seconds':
      return { axis: t('annotators’ time'), choice: t('Annotators’ time') };
  }
}

export function xAxisOf(name: string | null): XAxisName {
  return name !== null && Object.hasOwn(X_AXES, name) ? (name as XAxisName) : 'episode';
}

/** Return success as a series. Over cost or time it is a step function: the success reached so far. */
export function successOf(curves: Curves, xAxis: XAxisName): Series[] {
  const x = X_AXES[xAxis].of(curves);
  if (!curves.success_rate.some((rate) => rate !== null)) return [];
  return [
    {
      label: t('Success'),
      mark: { color: 'accent', dash: '', marker: 'circle' },
      x,
      y: curves.success_rate,
      steps: xAxis !== 'episode',
    },
  ];
}

/** Return the cumulative cost by kind as stacked layers, the top layer first. Kinds without cost are omitted. */
export function stackOf(curves: Curves, xAxis: XAxisName): Series[] {
  const x = X_AXES[xAxis].of(curves);
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

/** Return the known curves followed by more. */
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
    cost_by_kind: Object.fromEntries(kinds) as Curves['cost_by_kind'],
    hi_labels: [...known.hi_labels, ...more.hi_labels],
    lo_samples: [...known.lo_samples, ...more.lo_samples],
    learner_seconds: [...known.learner_seconds, ...more.learner_seconds],
    reward: [...known.reward, ...more.reward],
    reached: Object.fromEntries(
      Object.keys({ ...known.reached, ...more.reached }).map((subgoal) => [
        subgoal,
        [
          ...(known.reached[subgoal] ?? known.episode.map(() => 0)),
          ...(more.reached[subgoal] ?? more.episode.map(() => 0)),
        ],
      ]),
    ),
  };
}

/** Load the episodes after the known curves, of very many only `most`, and return the curves with them. */
export async function updatedCurves(
  run: string,
  known: Curves | null,
  most: number | null = null,
): Promise<Curves> {
  const params = { path: { run }, query: { after: known?.episode.at(-1) ?? -1, most } };
  return joined(known, await unwrap(api.GET('/api/v1/runs/{run}/curves', { params })));
}
