// What a run's configuration says: its settings, and what it used instead of parts that its domain does not provide.
import type { Run } from './types';

const NOT_PROVIDED = 'not_provided';

/** The settings of a run, as text by name, without what was used instead of missing parts. */
export function settingsOf(run: Run): [string, string][] {
  return Object.entries(run.config)
    .filter(([name]) => name !== NOT_PROVIDED)
    .map(([name, value]) => [
      name.replaceAll('_', ' '),
      typeof value === 'string' ? value : JSON.stringify(value),
    ]);
}

/** What the run used instead of each part that its domain does not provide, by the part's name. */
export function missingPartsOf(run: Run): [string, string][] {
  const parts = run.config[NOT_PROVIDED];
  if (typeof parts !== 'object' || parts === null) return [];
  return Object.entries(parts).map(([part, instead]) => [part, String(instead)]);
}
