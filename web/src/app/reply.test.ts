import { expect, it } from 'vitest';
import { replyOf } from './reply';

it.each([
  ['state=s&code=c', { state: 's', code: 'c', issuer: null }],
  ['state=s&code=c&iss=https%3A%2F%2Fa.example', { state: 's', code: 'c', issuer: 'https://a.example' }],
  ['state=s&error=access_denied', { state: 's', code: null, issuer: null }],
  ['state=s', null],
  ['code=c', null],
  ['run=a&without=label_hi', null],
  ['', null],
])('%s is a reply of a provider, or is not', (search, reply) => {
  expect(replyOf(new URLSearchParams(search))).toEqual(reply);
});
