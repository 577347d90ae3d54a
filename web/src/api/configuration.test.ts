import { expect, test } from 'vitest';
import type { Run } from './types';
import { missingPartsOf, settingsOf } from './configuration';

const run = (config: Run['config']): Run => ({ config }) as Run;

test('settings are shown as text, and missing parts apart', () => {
  const shown = run({
    domain: 'taxi',
    in_flight: 4,
    redraw: false,
    extra: { a: [1] },
    not_provided: { views: 'Policies see whole observations.' },
  });
  expect(settingsOf(shown)).toEqual([
    ['domain', 'taxi'],
    ['in flight', '4'],
    ['redraw', 'false'],
    ['extra', '{"a":[1]}'],
  ]);
  expect(missingPartsOf(shown)).toEqual([['views', 'Policies see whole observations.']]);
});

test('a configuration of any program is shown, whatever it stores', () => {
  for (const value of [undefined, null, 3, 'text', []]) {
    expect(missingPartsOf(run({ not_provided: value }))).toEqual([]);
  }
});
