import { describe, expect, it } from 'vitest';
import { extent } from '../../charts/chart';
import type { Forecast, ForecastRange, Run } from '../../api/types';
import { goalOf, sentencesOf, sourcesOf, targetOf } from './forecast';

const RUN = { state: 'running', spent: 200, budget: null } as unknown as Run;

function forecast(more: Partial<Forecast> = {}): Forecast {
  return {
    ...{ target: '0.9', reached: null, too_early: null, more_units: null, more_seconds: null, missed: 0 },
    ...{ same_configuration: 4, other_configurations: 0, ...more },
  };
}
const range = (low: number | null, median: number | null, high: number | null): ForecastRange => ({
  ...{ low, median, high },
});

describe('a forecast in words', () => {
  const said = (more: Partial<Forecast>, run: Partial<Run> = {}, tests = 100): string =>
    sentencesOf(forecast(more), { ...RUN, ...run }, tests).join(' ');

  it.each<[string, Partial<Forecast>, string]>([
    [
      'a range',
      { more_units: range(81.4, 123.4, 256) },
      'About 120 more units (81 to 260) until 90% of tests succeed.',
    ],
    ['one unit', { more_units: range(1, 1, 2) }, 'About 1 more unit (1 to 2) until 90% of tests succeed.'],
    [
      'another target',
      { target: '0.99', more_units: range(1000, 2345, 3456) },
      'About 2,300 more units (1,000 to 3,500) until 99% of tests succeed.',
    ],
    [
      'no upper end',
      { more_units: range(81, 123, null), missed: 0.163 },
      'About 120 more units (81 or more) until 90% of tests succeed. In 16% of the possible futures it never gets there.',
    ],
    [
      'perhaps never',
      { more_units: range(81, null, null), missed: 0.6 },
      'At least 81 more units until 90% of tests succeed, if ever. In 60% of the possible futures it never gets there.',
    ],
    [
      'probably never',
      { more_units: range(null, null, null), missed: 0.97 },
      '90% of tests will probably never succeed. In 97% of the possible futures it never gets there.',
    ],
    [
      'too early',
      { too_early: 'There is nothing to compare with.' },
      'Too early to say when 90% of tests succeed. There is nothing to compare with.',
    ],
    [
      'reached',
      { reached: { episode: 99, cost: 351.5 } },
      '90% of tests succeeded after 351.5 units, in episode 99.',
    ],
    [
      'the time of people',
      { more_units: range(80, 120, 260), more_seconds: range(120, 180, 390) },
      'About 120 more units (80 to 260) until 90% of tests succeed. ' +
        'For the annotators, this is 3 min of work (2 min to 7 min).',
    ],
  ])('%s', (_, more, words) => {
    expect(said(more)).toBe(words);
  });

  it('says what the budget leaves if it may not be enough', () => {
    const more_units = range(81, 123, 256);
    expect(said({ more_units }, { budget: 300 })).toMatch(/The budget leaves 100 units\.$/);
    expect(said({ more_units: range(81, 123, null) }, { budget: 9_000 })).toMatch(/leaves 8,800 units\.$/);
    expect(said({ more_units }, { budget: 456 })).not.toContain('budget');
  });

  it('speaks of a finished run as of one that goes on no more', () => {
    expect(said({ more_units: range(81, 123, 256) }, { state: 'finished' })).toMatch(
      /^The run ended before 90% of tests succeeded\. If it had gone on: About 120 more units/,
    );
  });

  it('says of a finished run with few tests that none of its successes counts yet', () => {
    expect(said({ more_units: range(81, 123, 256) }, { state: 'finished' }, 60)).toMatch(
      /^The run ended with 60 tests\. A level of success counts as reached from the 100th test on\. If it had/,
    );
  });

  it('says what it was made from', () => {
    const more_units = range(1, 2, 3);
    const sources = (more: Partial<Forecast>): string | undefined =>
      sourcesOf(forecast({ more_units, ...more }))?.split('.')[0];
    expect(sources({ same_configuration: 1, other_configurations: 12 })).toBe(
      'From this run’s own curve, 1 finished run with the same configuration and 12 finished runs with other configurations',
    );
    expect(sources({ same_configuration: 0, other_configurations: 1 })).toBe(
      'From this run’s own curve and 1 finished run with another configuration',
    );
    expect(sources({ same_configuration: 2 })).toBe(
      'From this run’s own curve and 2 finished runs with the same configuration',
    );
    expect(sources({ same_configuration: 0 })).toBe('From this run’s own curve');
    expect(sourcesOf(forecast())).toBeNull();
  });

  it('has four targets, 90% unless the address names another', () => {
    expect([null, '0.95', '0.5'].map(targetOf)).toEqual(['0.9', '0.95', '0.9']);
  });
});

describe('a forecast in the chart', () => {
  it('is a span of units at the target', () => {
    const more_units = range(80, 120, 180);
    expect(goalOf(forecast({ more_units }), 200, 'cost')).toEqual({
      y: 0.9,
      label: 'target 90%',
      span: { from: 280, to: 380, middle: 320, label: 'forecast' },
    });
    expect(goalOf(forecast({ more_units }), 200, 'episode').span).toBeNull();
    expect(goalOf(forecast(), 200, 'cost').span).toBeNull();
  });

  it('leaves room for the curve where it ends far away, or never', () => {
    for (const high of [null, 90_000]) {
      const goal = goalOf(forecast({ more_units: range(80, 120, high) }), 200, 'cost');
      expect(goal.span).toEqual({ from: 280, to: 400, middle: 320, label: 'forecast →' });
      const curve = {
        label: '',
        mark: { color: '', dash: '', marker: 'circle' as const },
        x: [0, 200],
        y: [0, 1],
      };
      expect(extent([curve], goal).x).toEqual([0, 400]);
    }
  });
});
