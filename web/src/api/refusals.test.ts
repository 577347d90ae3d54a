import { expect, test } from 'vitest';
import { Refused, wordsOf } from './client';

type Problem = ConstructorParameters<typeof Refused>[1];

function said(name: string, members: Problem = {}): string {
  return wordsOf(new Refused(418, { type: `/problems/${name}`, detail: 'in English', ...members }));
}

function saidOf(loc: string[], type: string): string {
  return said('unprocessable', { errors: [{ loc, type, msg: 'in English' }] });
}

test('a refusal that people can meet is in the words of the page', () => {
  expect(said('lease-ended')).toBe('The question was answered, skipped or given back before.');
  expect(said('last-administrator')).toContain('the only administrator');
});

test('who may not do something reads whose role or run it takes', () => {
  expect(said('forbidden', { roles: ['admin', 'learner'] })).toBe('This needs the role admin or learner.');
  expect(said('forbidden', { owner: 'Zoe' })).toContain('This run belongs to Zoe.');
  expect(said('forbidden')).toBe('Your role does not allow this.');
});

test('a budget that is too low is refused with the units it must have', () => {
  const words = said('budget-too-low', { spent: 1_200.5, reserved: 34 });
  expect(words).toContain('1,200.5 units are spent and 34 are reserved');
  expect(words).toContain('at least 1,234.5');
  expect(said('budget-too-low')).toBe('in English'); // an older server says no numbers
});

test.each([
  ['string_too_short', '“Name” is empty.'],
  ['string_too_long', '“Name” is too long.'],
  ['string_pattern_mismatch', '“Name” has a character that is not allowed.'],
  ['less_than_equal', '“Name” cannot have this value.'],
])('a form reads which of its fields is refused: %s', (type, words) =>
  expect(saidOf(['body', 'name'], type)).toBe(words),
);

test('a filter has the name that it has on the page', () => {
  expect(saidOf(['query', 'text'], 'string_too_long')).toBe('“Find a query” is too long.');
});

test('what no form of the page sends is refused in the words of the server', () => {
  expect(saidOf(['body', 'vocabulary', 'name'], 'string_too_long')).toBe('in English');
  expect(said('unprocessable')).toBe('in English');
  expect(said('toString')).toBe('in English');
  expect(wordsOf(new Refused(418, undefined))).toBe('The server answered with status 418.');
});
