import { describe, expect, it } from 'vitest';
import { spreadOf } from './compared';

describe('runs side by side', () => {
  it('have a median and a range', () => {
    expect(spreadOf([3, 1, 2])).toEqual({ median: 2, low: 1, high: 3 });
    expect(spreadOf([1, 2])).toEqual({ median: 1.5, low: 1, high: 2 });
  });

  it('count as more than any number where they did not reach a level', () => {
    expect(spreadOf([null, 5, 4])).toEqual({ median: 5, low: 4, high: Infinity });
    expect(spreadOf([null, null, 4]).median).toBe(Infinity);
    expect(spreadOf([null, 4]).median).toBe(Infinity); // not a number between 4 and nothing
  });
});
