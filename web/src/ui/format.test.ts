import { describe, expect, it, vi } from 'vitest';
import { ago, count, percent, seconds } from './format';

describe('numbers in words', () => {
  it('are short and plain', () => {
    expect([count(1, ['# answer', '# answers']), count(1420, ['# unit', '# units'])]).toEqual([
      '1 answer',
      '1,420 units',
    ]);
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

it('numbers, dates and lists are written as in the region of the page', async () => {
  vi.resetModules();
  vi.doMock('../language/language', () => ({ locale: 'de-DE', t: (text: string) => text }));
  const format = await import('./format');
  vi.doUnmock('../language/language');
  expect([format.number(1420.5), format.percent(0.845)]).toEqual(['1.420,5', '84,5\u00a0%']);
  expect(format.day(1_772_500_000)).toBe('03.03.2026');
  expect(format.either(['north', 'east', 'south'])).toBe('north, east oder south');
  expect(format.listed(['north', 'east', 'south'])).toBe('north, east und south');
});
