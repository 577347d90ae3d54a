import { expect, it } from 'vitest';
import { parseRoute, searchWith, wholeNumber } from './route';

it.each([
  ['/', '', { view: 'work', run: null, without: null }],
  ['/work', '?run=a%20b', { view: 'work', run: 'a b', without: null }],
  ['/work', '?without=hier_demo', { view: 'work', run: null, without: 'hier_demo' }],
  ['/work/', '', { view: 'work', run: null, without: null }],
  ['/runs', '', { view: 'runs' }],
  ['/runs/a%2Fb', '', { view: 'run', run: 'a/b', section: 'overview' }],
  ['/runs/%zz', '', { view: 'run', run: '%zz', section: 'overview' }],
  ['/runs/compare', '?run=a&run=b', { view: 'compare' }],
  ['/runs/a/ledger', '', { view: 'run', run: 'a', section: 'ledger' }],
  ['/runs/a/queries', '?kind=label_hi', { view: 'run', run: 'a', section: 'queries' }],
  ['/runs/a/queries/12', '', { view: 'query', run: 'a', query: 12 }],
  ['/runs/a/queries/x', '', { view: 'nowhere' }],
  ['/runs/a/queries/1/2', '', { view: 'nowhere' }],
  ['/login', '', { view: 'login' }],
  ['/work/7', '', { view: 'nowhere' }],
  ['/runs/1/2', '', { view: 'nowhere' }],
  ['/runs/a%2Fb/gold', '', { view: 'gold', run: 'a/b' }],
  ['/people', '', { view: 'people' }],
  ['/people/12', '', { view: 'person', user: 12 }],
  ['/people/audit', '?actor=ada', { view: 'audit' }],
  ['/people/audit/1', '', { view: 'nowhere' }],
  ['/people/0x1', '', { view: 'nowhere' }],
  ['/me', '', { view: 'me' }],
  ['/practice', '', { view: 'practice', first: false, run: null, work: '/work' }],
  [
    '/practice',
    '?first=yes&without=label_lo',
    { view: 'practice', first: true, run: null, work: '/work?without=label_lo' },
  ],
  ['/else', '', { view: 'nowhere' }],
])('%s%s leads somewhere', (path, search, route) => {
  expect(parseRoute(path, search)).toEqual(route);
});

it('changes parameters of an address, adds lists and removes what is empty', () => {
  expect(searchWith('?kind=label_hi&after=7', { kind: '', before: '3', after: null })).toBe('?before=3');
  expect(searchWith('?x=cost&run=a&run=b', { run: ['b', 'c'] })).toBe('?x=cost&run=b&run=c');
  expect(searchWith('?kind=label_hi', { kind: null })).toBe('');
});

it('reads whole numbers, and nothing else', () => {
  expect(['12', '0', '-1', '1e3', '', null].map(wholeNumber)).toEqual([12, 0, null, null, null, null]);
});
