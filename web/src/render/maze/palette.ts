// The colors of the map.
import { readColor } from '../../ui/style/colors';
import { SUBGOAL_COLORS } from '../../ui/style/subgoals';

const NAMES = [
  'floor',
  'grid',
  'door',
  'door-frame',
  'lava',
  'target',
  'agent',
  'agent-edge',
  'label',
  'label-edge',
  'marker-text',
  'burnt',
] as const;
type Name = (typeof NAMES)[number];

/** The colors, as the style sheet defines them. */
export interface Palette {
  readonly map: Readonly<Record<Name, string>>;
  readonly subgoals: readonly string[];
}

export function readPalette(element: Element): Palette {
  const map = Object.fromEntries(NAMES.map((name) => [name, readColor(element, `var(--map-${name})`)]));
  const subgoals = Array.from({ length: SUBGOAL_COLORS }, (_, index) =>
    readColor(element, `var(--subgoal-${index})`),
  );
  return { map: map as Palette['map'], subgoals };
}
