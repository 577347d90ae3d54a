// @vitest-environment happy-dom
import { beforeEach, describe, expect, it } from 'vitest';
import { ANSWERABLE, type Vocabulary } from '../api/types';
import { bindingsFor, collisions, type Binding } from './registry';
import { idOf, loadKeymap, refusal, remapped, saveKeymap, type Keymap } from './remap';

const maze: Vocabulary = {
  domain: 'maze',
  renderer: 'maze',
  subgoals: ['north', 'south', 'west', 'east', 'go_to_target'],
  actions: ['up', 'down', 'left', 'right'],
};
const inspect = bindingsFor('inspect_full', maze);
const of = (bindings: readonly Binding[], command: string): Binding => {
  const found = bindings.find((binding) => binding.command === command);
  if (!found) throw new Error(command);
  return found;
};
const refused = (command: string, key: string, keymap: Keymap = {}): string | null =>
  refusal(of(inspect, command), key, keymap, maze);

describe('a key of one’s own', () => {
  it('replaces the default keys', () => {
    const bindings = remapped(inspect, { pass: 'j' });
    expect(of(bindings, 'pass').keys).toEqual(['j']);
    expect(of(bindings, 'fail').keys).toEqual(['n', 'f']);
  });

  it('belongs to the name of a subgoal or action, at any place in the vocabulary', () => {
    const keymap = { 'choose go to target': 'g' };
    const other = { ...maze, subgoals: ['go_to_target', 'north'] };
    expect(of(remapped(bindingsFor('label_hi', maze), keymap), 'choose:4').keys).toEqual(['g']);
    expect(of(remapped(bindingsFor('label_hi', other), keymap), 'choose:0').keys).toEqual(['g']);
  });

  it('is refused if another binding of one of its modes has it', () => {
    expect(refused('pass', 'f')).toContain('F already means “No, it failed”');
    expect(refused('pass', 'x')).toBeNull(); // First wrong is of labels alone
    expect(refused('skip', 'x')).toContain('First wrong step');
    expect(refused('skip', 'w')).toContain('west');
    expect(refused('undo', 'j', { pass: 'j' })).toContain('Yes, it worked');
  });

  it('may be the default key, or a key that another binding has given up', () => {
    expect(refused('pass', 'p', { pass: 'j' })).toBeNull();
    expect(refused('fail', 'p', { pass: 'j' })).toBeNull();
  });

  it('is refused if it has another meaning in a demonstration', () => {
    const demo = bindingsFor('hier_demo', maze);
    const refusedTo = (command: string, key: string, keymap: Keymap = {}): string | null =>
      refusal(of(demo, command), key, keymap, maze);
    expect(refusedTo('act:0', '?')).toContain('Show every key');
    expect(refusedTo('act:0', 'Enter')).toContain('The subgoal is reached');
    expect(refusedTo('act:0', 'n')).toContain('north');
    expect(refusedTo('act:0', 'ArrowDown')).toContain('down');
    expect(refusedTo('reached', 'ArrowDown')).toContain('down');
    expect(refusedTo('act:0', 'j')).toBeNull();
    expect(refusedTo('act:1', 'j', { [idOf(of(demo, 'act:0'))]: 'j' })).toContain('up');
    expect(refused('undo', 'Shift+Backspace')).toContain('Start over');
  });

  it('belongs to the name of a move, at any place in the vocabulary', () => {
    const keymap = { [idOf(of(bindingsFor('hier_demo', maze), 'act:3'))]: 'l' };
    const other = { ...maze, actions: ['right', 'left', 'down', 'up'] };
    expect(of(remapped(bindingsFor('hier_demo', other), keymap), 'act:0').keys).toEqual(['l']);
    expect(of(remapped(bindingsFor('hier_demo', other), keymap), 'act:3').keys).toEqual(['ArrowUp']);
  });

  it('cannot be a key that the browser needs', () => {
    for (const key of ['Tab', 'Escape', 'Shift']) expect(refused('pass', key)).toContain('cannot be chosen');
  });

  it('never does two things, even where a vocabulary has the same letter', () => {
    const keymap = { skip: 'w', pass: 'j' };
    for (const mode of [...ANSWERABLE, 'waiting'] as const) {
      expect(collisions(remapped(bindingsFor(mode, maze), keymap))).toEqual([]);
    }
    expect(of(remapped(bindingsFor('label_hi', maze), keymap), 'choose:2').keys).toEqual(['3']);
  });

  it('never does two things, even where two moves got the same key in different domains', () => {
    const keymap = { 'act up': 'j', 'act down': 'j' };
    const bindings = remapped(bindingsFor('hier_demo', maze), keymap);
    expect(collisions(bindings)).toEqual([]);
    expect(of(bindings, 'act:0').keys).toEqual(['j']);
    expect(of(bindings, 'act:1').keys).toEqual(['ArrowDown']);
  });
});

describe('the keymap', () => {
  beforeEach(() => localStorage.clear());

  it('is kept by the browser, whatever else is in its place', () => {
    saveKeymap(localStorage, { pass: 'j' });
    expect(loadKeymap(localStorage)).toEqual({ pass: 'j' });
    saveKeymap(localStorage, {});
    expect(localStorage).toHaveLength(0);
    for (const broken of ['{', '7', 'null', '{"pass": 3}']) {
      localStorage.setItem('waypost:keys', broken);
      expect(loadKeymap(localStorage)).toEqual({});
    }
  });
});
