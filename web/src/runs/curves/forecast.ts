// The forecast of a run in words, and as a part of its chart.
import type { Forecast, ForecastRange, Run } from '../../api/types';
import { inOurWords } from '../../api/wordings/wordings';
import type { Goal } from '../../charts/chart';
import { t } from '../../language/language';
import { count, number, percent, seconds, units } from '../../ui/format';
import { WINDOW, type XAxisName } from './curves';

export type Target = Forecast['target'];
export const TARGETS = ['0.8', '0.9', '0.95', '0.99'] as const satisfies readonly Target[];

export function targetOf(name: string | null): Target {
  return TARGETS.find((target) => target === name) ?? '0.9';
}

/** Return what is known about a run's way to its target, as sentences. */
export function sentencesOf(forecast: Forecast, run: Run, tests: number): string[] {
  const target = percent(Number(forecast.target));
  const { reached, too_early, more_units, more_seconds } = forecast;
  if (reached) {
    return [
      t(`${target} of tests succeeded after ${units(reached.cost)}, in episode ${number(reached.episode)}.`),
    ];
  }
  const ended = run.state === 'finished' ? [...endedBefore(target, tests), t('If it had gone on:')] : [];
  if (too_early !== null)
    return [...ended, t(`Too early to say when ${target} of tests succeed. ${inOurWords(too_early)}`)];
  if (more_units === null) return ended;
  return [
    ...ended,
    unitsLeft(more_units, forecast.missed ?? 0, target),
    ...(more_seconds?.median != null ? [timeLeft(more_seconds)] : []),
    ...budgetLeft(run, more_units),
  ];
}

/** Say why a finished run has not reached its target. */
function endedBefore(target: string, tests: number): string[] {
  if (tests >= WINDOW) return [t(`The run ended before ${target} of tests succeeded.`)];
  return [count(tests, ['The run ended with # test.', 'The run ended with # tests.']), fromTestOn()];
}

/** Say from which test on a level of success counts as reached. */
export function fromTestOn(): string {
  return t('A level of success counts as reached from the 100th test on.');
}

function unitsLeft({ low, median, high }: ForecastRange, missed: number, target: string): string {
  const share = percent(Math.round(missed * 100) / 100);
  const never = t(`In ${share} of the possible futures it never gets there.`);
  if (low === null) return t(`${target} of tests will probably never succeed. ${never}`);
  const [least, most] = [number(rough(low)), high === null ? null : number(rough(high))];
  if (median === null) {
    const more = count(rough(low), ['At least # more unit', 'At least # more units']);
    return t(`${more} until ${target} of tests succeed, if ever. ${never}`);
  }
  const about = count(rough(median), ['About # more unit', 'About # more units']);
  if (most === null) return t(`${about} (${least} or more) until ${target} of tests succeed. ${never}`);
  return t(`${about} (${least} to ${most}) until ${target} of tests succeed.`);
}

function timeLeft({ low, median, high }: ForecastRange): string {
  const least = seconds(low ?? 0);
  const range = high === null ? t(`${least} or more`) : t(`${least} to ${seconds(high)}`);
  return t(`For the annotators, this is ${seconds(median ?? 0)} of work (${range}).`);
}

function budgetLeft({ budget, spent }: Run, { high }: ForecastRange): string[] {
  if (budget === null || (high !== null && high <= budget - spent)) return [];
  return [t(`The budget leaves ${units(budget - spent)}.`)];
}

/** Return what a forecast was made from. */
export function sourcesOf({ more_units, same_configuration, other_configurations }: Forecast): string | null {
  if (more_units === null) return null;
  const brackets = t(`In brackets: the middle ${percent(0.8)} of the possible futures.`);
  if (same_configuration + other_configurations === 0) return t(`From this run’s own curve. ${brackets}`);
  const same = count(same_configuration, [
    '# finished run with the same configuration',
    '# finished runs with the same configuration',
  ]);
  const others = count(other_configurations, [
    '# finished run with another configuration',
    '# finished runs with other configurations',
  ]);
  if (same_configuration === 0) return t(`From this run’s own curve and ${others}. ${brackets}`);
  if (other_configurations === 0) return t(`From this run’s own curve and ${same}. ${brackets}`);
  return t(`From this run’s own curve, ${same} and ${others}. ${brackets}`);
}

/** Return the goal to draw against units; against anything else, only the line of the target. */
export function goalOf(forecast: Forecast, spent: number, xAxis: XAxisName): Goal {
  const y = Number(forecast.target);
  const label = t(`target ${percent(y)}`);
  const { low, median, high } = forecast.more_units ?? { low: null, median: null, high: null };
  if (xAxis !== 'cost' || low === null) return { y, label, span: null };
  // A long way off would leave no room for the curve itself.
  const most = Math.max(2 * spent, spent + 1.2 * (median ?? low));
  const to = high === null ? most : Math.min(spent + high, most);
  const isCut = high === null || spent + high > most;
  const middle = median === null ? null : spent + median;
  return {
    y,
    label,
    span: { from: spent + low, to, middle, label: isCut ? t('forecast →') : t('forecast') },
  };
}

/** Return a number with two digits that count. */
function rough(value: number): number {
  return value < 10 ? Math.max(1, Math.round(value)) : Number(value.toPrecision(2));
}
