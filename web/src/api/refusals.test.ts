import { expect, test } from 'vitest';
import { Refused, wordsOf } from './client';

test('a refusal that annotators can meet is in the words of the page', () => {
  const refused = new Refused(409, {
    type: '/problems/lease-ended',
    detail: 'The assignment was already released.',
  });
  expect(wordsOf(refused)).toBe('The question was answered, skipped or given back before.');
});

test.each([
  [{ type: '/problems/unprocessable', detail: 'body.label: is too long' }, 'body.label: is too long'],
  [{ type: '/problems/toString', detail: 'something new' }, 'something new'],
  [undefined, 'The server answered with status 418.'],
])('else it is in the words of the server: %j', (problem, words) => {
  expect(wordsOf(new Refused(418, problem))).toBe(words);
});
