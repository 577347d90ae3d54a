import type { Curves, Kind } from '../api/types';

/** In the order of the paper's algorithm, from the bottom of the stack up. */
const KINDS: readonly Kind[] = [
  'hier_demo',
  'inspect_full',
  'label_hi',
  'inspect_lo',
  'label_lo',
  'label_full',
];

/** Cumulative cost by kind: `own` what the kind cost, `upTo` that and all kinds below it. */
export interface Layer {
  readonly kind: Kind;
  readonly own: readonly number[];
  readonly upTo: readonly number[];
}

/** Only kinds that ever cost something. */
export function stack(curves: Curves): Layer[] {
  const layers: Layer[] = [];
  for (const kind of KINDS) {
    const own = curves.cost_by_kind[kind] ?? [];
    if (!own.some((units) => units > 0)) continue;
    const below = layers.at(-1)?.upTo;
    layers.push({ kind, own, upTo: own.map((units, row) => units + (below?.[row] ?? 0)) });
  }
  return layers;
}

/** At most `most` rows, evenly spread, the last one always among them. */
export function sampleRows(length: number, most: number): number[] {
  if (length <= most) return Array.from({ length }, (_, row) => row);
  const stride = (length - 1) / (most - 1);
  return Array.from({ length: most }, (_, index) => Math.round(index * stride));
}
