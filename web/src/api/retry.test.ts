import { expect, it } from 'vitest';
import { delay } from './retry';

it('waits longer after each failed attempt, up to a limit', () => {
  expect([1, 2, 3, 4, 5, 9].map(delay)).toEqual([500, 1000, 2000, 4000, 8000, 8000]);
});
