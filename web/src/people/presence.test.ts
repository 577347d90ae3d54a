import { expect, it } from 'vitest';
import { presence } from './presence';

const NOW = 1_000_000;

it.each([
  ['somebody who called lately', NOW - 300, 0, 'active 5 min ago'],
  ['somebody who was let in and did not come', null, 0, 'never signed in'],
  ['an oracle whose answers came with an import', null, 4_000, 'not signed in'],
])('says of %s when they were here', (_, lastUsed, answers, words) => {
  expect(presence(lastUsed, answers, NOW)).toBe(words);
});
