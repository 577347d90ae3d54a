import { describe, expect, it } from 'vitest';
import { ago, count, percent, seconds } from './format';

describe('numbers in words', () => {
  it('are short and plain', () => {
    expect([count(1, 'answer'), count(1420, 'unit')]).toEqual(['1 answer', '1,420 units']);
    expect([percent(null), percent(0.845), percent(1)]).toEqual(['–', '84.5%', '100%']);
    expect([3.14, 240, 7500].map(seconds)).toEqual(['3.1 s', '4 min', '2 h 5 min']);
    expect([5, 300, 7200, 200_000].map((passed) => ago(0, passed))).toEqual([
      'just now',
      '5 min ago',
      '2 h ago',
      '2 d ago',
    ]);
  });
});
