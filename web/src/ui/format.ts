// Numbers, times, counts and lists as text, in the page's language and as its region writes them.
import { locale, t } from '../language/language';

// A formatter takes a browser up to 20 ms to make. Each is made when the first text needs it, not when the page starts.
const numbers = once(() => new Intl.NumberFormat(locale, { maximumFractionDigits: 2 }));
const percents = once(() => new Intl.NumberFormat(locale, { style: 'percent', maximumFractionDigits: 1 }));
const days = once(() => new Intl.DateTimeFormat(locale, { dateStyle: 'medium' }));
const moments = once(() => new Intl.DateTimeFormat(locale, { dateStyle: 'medium', timeStyle: 'medium' }));
const alternatives = once(() => new Intl.ListFormat(locale, { type: 'disjunction' }));
const enumerations = once(() => new Intl.ListFormat(locale, { type: 'unit', style: 'short' }));

function once<T>(make: () => T): () => T {
  let made: T | undefined;
  return () => (made ??= make());
}

/** Make the formatters of numbers and shares, while a view that needs both waits for its data anyway. */
export function makeFormatters(): void {
  numbers();
  percents();
}

/** Return a number as text: 1,420. */
export function number(value: number): string {
  if (Number.isInteger(value) && value >= 0 && value < 1_000) return String(value); // needs no formatter
  return numbers().format(value);
}

/** Return a share in percent: 84.5%; a dash for null. */
export function percent(value: number | null): string {
  return value === null ? '–' : percents().format(value);
}

/** Return an amount in units: 1 unit, 12 units. */
export function units(value: number): string {
  return count(value, ['# unit', '# units']);
}

/**
 * Return the form that belongs to a number, with the number for `#`: for 2 and '# answers', 2 answers.
 * The build puts the forms of the page's language in their place, and the function that chooses one of them.
 */
export function count(
  value: number,
  forms: readonly string[],
  choose = (amount: number): number => (amount === 1 ? 0 : 1),
): string {
  return (forms[choose(value)] ?? '').replaceAll('#', number(value));
}

/** Return a duration in seconds as text: 3.1 s, 4 min, 2 h 5 min. */
export function seconds(value: number): string {
  if (value < 60) return t(`${number(Math.round(value * 10) / 10)} s`);
  const minutes = Math.round(value / 60);
  if (minutes < 60) return t(`${minutes} min`);
  return t(`${Math.floor(minutes / 60)} h ${minutes % 60} min`);
}

/** Return how long ago a time was: just now, 5 min ago, 3 h ago, 2 d ago. */
export function ago(then: number, now: number): string {
  const passed = now - then;
  if (passed < 60) return t('just now');
  if (passed < 3_600) return t(`${Math.floor(passed / 60)} min ago`);
  if (passed < 86_400) return t(`${Math.floor(passed / 3_600)} h ago`);
  return count(Math.floor(passed / 86_400), ['# d ago', '# d ago']);
}

/** Return the day of a time: 3 Mar 2026. */
export function day(at: number): string {
  return days().format(at * 1000);
}

/** Return a time as text: 3 Mar 2026, 14:05:09. */
export function moment(at: number): string {
  return moments().format(at * 1000);
}

/** Return alternatives as text: north, east or south. */
export function either(names: readonly string[]): string {
  return alternatives().format(names);
}

/** Return names one after another: north, east, south. */
export function listed(names: readonly string[]): string {
  return enumerations().format(names);
}
