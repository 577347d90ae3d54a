import { expect, test } from 'vitest';
import { actionOf, detailsOf, endOfDay, startOfDay } from './audit';

test('details are read as words, without what is not set', () => {
  const details = { name: 'ada', expires: null, label: '', left_out: { me: 4 } };
  expect(detailsOf(details)).toBe('name: ada, left out: {"me":4}');
});

test('only an action of the log is an action', () => {
  expect(['login', 'constructor', null].map(actionOf)).toEqual(['login', null, null]);
});

test('a day is from its midnight to the next, and anything else is no day', () => {
  const start = new Date(2026, 2, 1).getTime() / 1000;
  const next = new Date(2026, 2, 2).getTime() / 1000;
  expect([startOfDay('2026-03-01'), endOfDay('2026-03-01')]).toEqual([start, next]);
  expect(['', '1 March', '2026-3-1'].map(startOfDay)).toEqual([null, null, null]);
  expect(endOfDay('')).toBeNull();
});
