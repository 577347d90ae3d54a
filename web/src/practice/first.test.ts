// @vitest-environment happy-dom
import { beforeEach, expect, test } from 'vitest';
import type { Kind, Me, Outlook, Practice } from '../api/types';
import { domainsToPractice, firstDemonstrations, firstQueries, isNew, remember } from './first';
import { formOf } from './worked';

const me = (more: Partial<Me>): Me => ({ id: 7, role: 'annotator', answers: 0, ...more }) as Me;
const kinds: Kind[] = ['inspect_full', 'inspect_full', 'label_hi', 'label_hi', 'label_lo'];
const practice = {
  vocabulary: { domain: 'maze', subgoals: ['north'] },
  queries: kinds.map((kind, id) => ({ id, ask: { kind } })),
  examples: [{ query: 1 }, { query: 3 }],
  demonstrations: [
    { ask: { flat: false, context: [] } },
    { ask: { flat: true, context: [] } },
    { ask: { flat: false, context: ['failed'] } },
  ],
  domains: ['maze', 'taxi'],
} as unknown as Practice;
const outlook = (...runs: object[]): Outlook => ({ open: 0, runs }) as unknown as Outlook;
const forms = (found: ReturnType<typeof firstDemonstrations>): string[] =>
  found.map(({ ask }) => formOf(ask));
const ids = (found: Practice['queries']): number[] => found.map(({ id }) => id);

beforeEach(() => localStorage.clear());

test('only an annotator who has answered nothing and has not practiced is new', () => {
  expect(isNew(me({}), localStorage)).toBe(true);
  expect(isNew(me({ answers: 1 }), localStorage)).toBe(false);
  expect(isNew(me({ role: 'admin' }), localStorage)).toBe(false);
  remember(me({}), localStorage);
  expect(isNew(me({}), localStorage)).toBe(false);
  expect(isNew(me({ id: 8 }), localStorage)).toBe(true);
});

test('one of each kind that is asked is practiced, and none that is a worked example', () => {
  const run = { domain: 'maze', doing: 'asking', kinds: ['label_hi', 'hier_demo'] };
  expect(ids(firstQueries(practice, outlook(run)))).toEqual([2]);
  expect(ids(firstQueries(practice, outlook({ ...run, kinds: [] })))).toEqual([0, 2, 4]);
  expect(ids(firstQueries(practice, outlook({ ...run, kinds: ['hier_demo', 'inspect_full'] })))).toEqual([
    0, 2, 4,
  ]);
  expect(ids(firstQueries(practice, outlook()))).toEqual([0, 2, 4]);
});

test('what is practiced are the domains of learners at work that have practice', () => {
  const run = (domain: string, doing = 'asking'): object => ({
    run: `of ${domain}`,
    domain,
    doing,
    kinds: [],
  });
  const found = (run: string | null, ...runs: object[]) => domainsToPractice(practice, outlook(...runs), run);
  expect(found(null, run('other'), run('taxi'), run('maze'), run('taxi'))).toEqual(['taxi', 'maze']);
  expect(found(null, run('taxi', 'finished'), run('maze'))).toEqual(['maze']);
  expect(found(null, run('other'))).toEqual([]);
  expect(found(null, run('other', 'finished'))).toEqual(['maze', 'taxi']);
  expect(found('of other', run('other'), run('taxi'))).toEqual([]);
  expect(found('of taxi', run('maze'), run('taxi'))).toEqual(['taxi']);
  expect(found('of long ago', run('maze'), run('taxi'))).toEqual(['maze', 'taxi']);
});

test('nothing is practiced for a domain of which the person gets no queries', () => {
  const other = { domain: 'taxi', doing: 'asking', kinds: ['label_hi'] };
  expect(firstQueries(practice, outlook(other))).toEqual([]);
  expect(ids(firstQueries(practice, outlook({ ...other, doing: 'finished' })))).toEqual([0, 2, 4]);
});

test('demonstrations to look at are those that the learners ask for or, at the beginning, may ask for', () => {
  const run = (kinds: Kind[], ...demonstrations: string[]): Outlook =>
    outlook({ domain: 'maze', doing: 'asking', kinds, demonstrations });
  const both = ['hier_demo', 'play_on'];
  expect(forms(firstDemonstrations(practice, outlook()))).toEqual(both);
  expect(forms(firstDemonstrations(practice, run(['hier_demo'], 'hier_demo')))).toEqual(both);
  expect(forms(firstDemonstrations(practice, run(['hier_demo'], 'flat_demo')))).toEqual(['flat_demo']);
  expect(forms(firstDemonstrations(practice, run(['hier_demo', 'label_hi'], 'hier_demo')))).toEqual([
    'hier_demo',
  ]);
  expect(forms(firstDemonstrations(practice, run(['label_hi'])))).toEqual([]);
  const flat = { ...practice, vocabulary: { ...practice.vocabulary, subgoals: [] } };
  expect(forms(firstDemonstrations(flat, outlook()))).toEqual(['flat_demo']);
});
