// Numbers, times and counts as text.
const NUMBER = new Intl.NumberFormat('en', { maximumFractionDigits: 2 });
const PERCENT = new Intl.NumberFormat('en', { style: 'percent', maximumFractionDigits: 1 });

/** Return a number as text: 1,420. */
export function number(value: number): string {
  return NUMBER.format(value);
}

/** Return a share in percent: 84.5%; a dash for null. */
export function percent(value: number | null): string {
  return value === null ? '–' : PERCENT.format(value);
}

/** Return an amount in units: 1 unit, 12 units. */
export function units(value: number): string {
  return count(value, 'unit');
}

/** Return a number with its noun: 1 answer, 2 answers. */
export function count(value: number, noun: string, nouns = `${noun}s`): string {
  return `${number(value)} ${value === 1 ? noun : nouns}`;
}

/** Return a duration in seconds as text: 3.1 s, 4 min, 2 h 5 min. */
export function seconds(value: number): string {
  if (value < 60) return `${NUMBER.format(Math.round(value * 10) / 10)} s`;
  const minutes = Math.round(value / 60);
  if (minutes < 60) return `${minutes} min`;
  return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/** Return how long ago a time was: just now, 5 min ago, 3 h ago, 2 d ago. */
export function ago(then: number, now: number): string {
  const passed = now - then;
  if (passed < 60) return 'just now';
  if (passed < 3_600) return `${Math.floor(passed / 60)} min ago`;
  if (passed < 86_400) return `${Math.floor(passed / 3_600)} h ago`;
  return `${Math.floor(passed / 86_400)} d ago`;
}

const DAY = new Intl.DateTimeFormat('en-GB', { dateStyle: 'medium' });

/** Return the day of a time: 3 Mar 2026. */
export function day(at: number): string {
  return DAY.format(at * 1000);
}

const CLOCK = new Intl.DateTimeFormat('en-GB', { dateStyle: 'medium', timeStyle: 'medium' });

/** Return a time as text: 3 Mar 2026, 14:05:09. */
export function moment(at: number): string {
  return CLOCK.format(at * 1000);
}
