import { expect, it } from 'vitest';
import type { Me, Run } from '../api/types';
import { bindingsFor } from '../keys/registry';
import { commandsOf, matching, partsOf, placesOf, viewsOf } from './find';

const me = (role: Me['role']) => ({ name: 'ada', role }) as Me;
const run = (name: string, state: Run['state']) => ({ id: 'a b', name, state }) as Run;
const words = (entries: readonly { words: string }[]) => entries.map((entry) => entry.words);

it('offers only views that the user may open', () => {
  expect(words(viewsOf(me('annotator')))).not.toContain('People');
  expect(words(viewsOf(me('admin')))).toEqual(expect.arrayContaining(['Work', 'People', 'Audit log']));
});

it('offers the questions of a run only while they can be answered', () => {
  expect(placesOf(run('maze', 'running'))).toMatchObject([
    { address: '/runs/a%20b' },
    { address: '/work?run=a%20b' },
  ]);
  expect(placesOf(run('maze', 'finished'))).toMatchObject([{ address: '/runs/a%20b' }]);
});

it('offers the parts of the run on the screen to those who may open them', () => {
  const there = { view: 'query', run: 'a b', query: 3 } as const;
  const addresses = (role: Me['role']) =>
    partsOf(there, me(role)).map((one) => 'address' in one && one.address);
  expect(addresses('viewer')).toEqual([
    '/runs/a%20b',
    '/runs/a%20b/queries',
    '/runs/a%20b/ledger',
    '/runs/compare?run=a%20b',
  ]);
  expect(addresses('admin')).toEqual(expect.arrayContaining(['/runs/a%20b/review', '/runs/a%20b/gold']));
  expect(addresses('annotator')).toEqual([]);
  expect(partsOf({ view: 'runs' }, me('admin'))).toEqual([]);
});

it('offers every command of the view with its key, but not itself', () => {
  const bindings = bindingsFor('inspect_full', null);
  const commands = commandsOf(bindings).map((entry) => 'command' in entry && entry.command);
  expect(commands).toEqual(bindings.map((one) => one.command).filter((one) => one !== 'find'));
});

it('finds entries that have every typed word in any order, those that begin with it first', () => {
  const entries = [
    { group: 'runs', words: 'big maze, lean', hint: 'running', address: '' },
    { group: 'runs', words: 'maze, paper', hint: 'paused', address: '' },
    { group: 'runs', words: 'corridor', hint: 'running', address: '' },
  ] as const;
  expect(words(matching(entries, 'MAZE'))).toEqual(['maze, paper', 'big maze, lean']);
  expect(words(matching(entries, ' running  big '))).toEqual(['big maze, lean']);
  expect(matching(entries, '')).toEqual(entries);
  expect(matching(entries, 'maze corridor')).toEqual([]);
});
