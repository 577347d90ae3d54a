// @vitest-environment happy-dom
import { afterEach, describe, expect, it, vi } from 'vitest';
import { initial, readable } from '../api/names';
import type { Vocabulary } from '../api/types';
import { keyOf, listen, match, printed, type KeyPress } from './keys';
import { remapped } from './remap';
import { numbered, tagOf } from './tags';
import { bindingsFor, collisions, MODES, type Binding, type Mode } from './registry';

const maze: Vocabulary = {
  domain: 'maze',
  renderer: 'maze',
  subgoals: ['north', 'south', 'west', 'east', 'go_to_target'],
  actions: ['up', 'down', 'left', 'right'],
};
const awkward: Vocabulary = {
  domain: 'awkward',
  renderer: 'none',
  subgoals: [
    'undo',
    'stairs',
    'skull',
    'x',
    'élan',
    ...Array.from({ length: 9 }, (_, index) => `more ${index}`),
  ],
  actions: ['Left', 'skip', 'fire', 'noop'],
};

const press = (key: string, more: Partial<KeyPress> = {}): KeyPress => ({
  key,
  code: '',
  shiftKey: false,
  ctrlKey: false,
  altKey: false,
  metaKey: false,
  repeat: false,
  isComposing: false,
  ...more,
});
const keysOf = (bindings: readonly Binding[], command: string) =>
  bindings.find((binding) => binding.command === command)?.keys;

afterEach(() => document.body.replaceChildren());

describe('the registry', () => {
  it.each(MODES)('has no key that does two things in %s', (mode) => {
    expect(collisions(bindingsFor(mode, maze))).toEqual([]);
    expect(collisions(bindingsFor(mode, awkward))).toEqual([]);
    expect(collisions(bindingsFor(mode, null))).toEqual([]);
  });

  it('reports a collision when there is one', () => {
    const twice: Binding[] = [
      { command: 'pass', keys: ['p'], label: '', group: 'Answer' },
      { command: 'play', keys: ['p', ' '], label: '', group: 'Player' },
    ];
    expect(collisions(twice)).toEqual(['p']);
  });

  it('gives the subgoals of the maze their letters and digits, and skip another key', () => {
    const bindings = bindingsFor('label_hi', maze);
    expect(maze.subgoals.map((_, index) => keysOf(bindings, `choose:${index}`)?.[0])).toEqual(
      Array.from('nswet'),
    );
    expect(keysOf(bindings, 'choose:4')).toEqual(['t', '5']);
    expect(keysOf(bindings, 'skip')).toEqual(['Shift+s']);
    expect(keysOf(bindingsFor('inspect_lo', maze), 'skip')).toEqual(['s', 'Shift+s']);
  });

  it('gives a letter only where it is free and means one subgoal', () => {
    const bindings = bindingsFor('label_hi', awkward);
    expect(keysOf(bindings, 'choose:0')).toEqual(['1']); // u is undo
    expect(keysOf(bindings, 'choose:1')).toEqual(['2']); // two begin with s
    expect(keysOf(bindings, 'choose:3')).toEqual(['x', '4']);
    expect(keysOf(bindings, 'choose:4')).toEqual(['5']);
    expect(keysOf(bindings, 'choose:10')).toEqual([]); // no digit left: by mouse
  });

  it.each(['label_lo', 'label_full', 'hier_demo', 'flat_demo'] as const)(
    'gives an action with a direction its arrow, whatever the domain calls it, in %s',
    (mode) => {
      const corridor = { ...maze, subgoals: ['west', 'east', 'target'], actions: ['west', 'east'] };
      const compass = { ...maze, subgoals: [], actions: ['North', 'south', 'up'] };
      const verb = mode.startsWith('label') ? 'choose' : 'act';
      const first = (vocabulary: Vocabulary) =>
        vocabulary.actions.map((_, index) => keysOf(bindingsFor(mode, vocabulary), `${verb}:${index}`)?.[0]);
      expect(first(corridor)).toEqual(['ArrowLeft', 'ArrowRight']);
      expect(first(compass)).toEqual(['ArrowUp', 'ArrowDown', 'p']); // u is undo
    },
  );

  it('lets arrows set actions where there are such actions, and step elsewhere', () => {
    expect(keysOf(bindingsFor('label_lo', maze), 'choose:2')).toEqual(['ArrowLeft', '3']);
    expect(keysOf(bindingsFor('label_lo', maze), 'back')).toEqual([',']);
    expect(keysOf(bindingsFor('label_lo', awkward), 'forward')).toEqual(['ArrowRight', '.']);
    expect(keysOf(bindingsFor('inspect_lo', maze), 'back')).toEqual(['ArrowLeft', ',']);
  });

  it('gives the actions of a demonstration arrows where they are so named, and subgoals their letters', () => {
    const bindings = bindingsFor('hier_demo', maze);
    expect(maze.actions.map((_, index) => keysOf(bindings, `act:${index}`))).toEqual([
      ['ArrowUp'],
      ['ArrowDown'],
      ['ArrowLeft'],
      ['ArrowRight'],
    ]);
    expect(keysOf(bindings, 'choose:0')).toEqual(['n', '1']);
    expect(keysOf(bindings, 'reached')).toEqual(['Enter', 'd']);
  });

  it('gives other actions of a demonstration a letter each, digits too where no subgoal needs them', () => {
    const hierarchical = bindingsFor('hier_demo', awkward);
    expect(awkward.actions.map((_, index) => keysOf(hierarchical, `act:${index}`))).toEqual([
      ['ArrowLeft'],
      ['s'],
      ['f', ' '],
      ['o'],
    ]);
    expect(keysOf(hierarchical, 'choose:3')).toEqual(['x', '4']);
    const many = { ...maze, actions: Array.from({ length: 30 }, (_, index) => `noop ${index}`) };
    const flat = bindingsFor('flat_demo', many);
    expect(collisions(flat)).toEqual([]);
    expect(keysOf(flat, 'act:1')).toEqual(['p', '2']);
    expect(flat.filter(({ command, keys }) => command.startsWith('act:') && keys.length === 0)).toHaveLength(
      12,
    );
  });

  it('gives the actions of a game their usual keys too in demonstrations, and leaves the player its own', () => {
    const game = { ...maze, actions: ['jump', 'left', 'jump_left', 'jump_right'] };
    const demo = bindingsFor('hier_demo', game);
    expect(game.actions.map((_, index) => keysOf(demo, `act:${index}`))).toEqual([
      ['j', ' '],
      ['ArrowLeft'],
      ['m', 'Shift+ArrowLeft'],
      ['p', 'Shift+ArrowRight'],
    ]);
    expect(collisions(demo)).toEqual([]);
    expect(keysOf(bindingsFor('label_lo', game), 'play')).toEqual([' ']);
  });

  it.each([
    ['maze', maze],
    ['awkward', awkward],
    [
      'game',
      { ...maze, subgoals: ['stair', 'key', 'door', 'jump'], actions: ['noop', 'jump', 'left', 'key'] },
    ],
  ])('gives a subgoal or an action the same key in every query: %s', (_, vocabulary) => {
    const first = (mode: Mode, label: string, verb: string): string | undefined =>
      bindingsFor(mode, vocabulary).find(
        (one) => one.label === readable(label) && one.command.startsWith(verb),
      )?.keys[0];
    for (const name of vocabulary.subgoals)
      expect(first('hier_demo', name, 'choose')).toBe(first('label_hi', name, 'choose'));
    for (const name of vocabulary.actions) {
      const key = first('label_lo', name, 'choose');
      expect(first('label_full', name, 'choose')).toBe(key);
      expect(first('flat_demo', name, 'act')).toBe(key);
      expect(first('hier_demo', name, 'act')).toBe(key);
    }
  });

  it('leaves every command of every mode reachable', () => {
    for (const mode of MODES) {
      const unreachable = bindingsFor(mode, maze).filter((binding) => binding.keys.length === 0);
      expect(unreachable).toEqual([]);
    }
  });

  it('knows a subgoal by its letter', () => {
    expect(['north', 'go_to_target', 'to_stairs', ''].map(initial)).toEqual(['N', 'T', 'S', '']);
  });
});

describe('the tag of a subgoal', () => {
  const game = ['stair', 'key', 'stair_back', 'door'];

  it('is the key that is printed on its button, which no other subgoal has', () => {
    const vocabulary = { domain: 'game', renderer: 'none', subgoals: game, actions: ['up'] };
    const keys = bindingsFor('hier_demo', vocabulary).slice(0, 4);
    expect(game.map((subgoal) => tagOf(subgoal, game))).toEqual(['1', 'K', '3', '4']);
    expect(keys.map((binding) => printed(binding.keys[0] ?? ''))).toEqual(['1', 'K', '3', '4']);
  });

  it('is its number where there are more subgoals than keys', () => {
    const many = Array.from({ length: 12 }, (_, number) => `${number} room`);
    expect(many.slice(-3).map((subgoal) => tagOf(subgoal, many))).toEqual(['0', '11', '12']);
  });

  it('is not read as a part of the number of its segment', () => {
    expect([numbered(2, 'N'), numbered(2, '4')]).toEqual(['2N', '2·4']);
  });
});

describe('a key press', () => {
  it('has one name', () => {
    expect(keyOf(press('P'))).toBe('p');
    expect(keyOf(press('S', { shiftKey: true }))).toBe('Shift+s');
    expect(keyOf(press('?', { shiftKey: true }))).toBe('?');
    expect(keyOf(press('Enter', { shiftKey: true }))).toBe('Shift+Enter');
  });

  it.each([
    ['Russian', 'з', 'KeyP', 'p'],
    ['Russian, a letter where others have a sign', 'х', 'BracketLeft', '['],
    ['Greek', 'π', 'KeyP', 'p'],
    ['Hebrew', 'פ', 'KeyP', 'p'],
    ['Arabic, two letters on one key', 'لا', 'KeyB', 'b'],
    ['Thai, a letter where others have a digit', 'ๅ', 'Digit1', '1'],
    ['Thai, a mark', '่', 'KeyJ', 'j'],
    ['Persian digits', '۲', 'Digit2', '2'],
  ])('is named by its place where the letters are not Latin: %s', (_, key, code, name) => {
    expect(keyOf(press(key, { code }))).toBe(name);
  });

  it('is named by its place with Shift, too', () => {
    expect(keyOf(press('Ы', { code: 'KeyS', shiftKey: true }))).toBe('Shift+s');
  });

  it.each([
    ['AZERTY', 'a', 'KeyQ', 'a'],
    ['AZERTY', 'm', 'Semicolon', 'm'],
    ['AZERTY', 'é', 'Digit2', 'é'],
    ['Dvorak', 'p', 'KeyR', 'p'],
    ['Dvorak', ',', 'KeyW', ','],
    ['German', 'ö', 'Semicolon', 'ö'],
    ['Russian', '?', 'Digit7', '?'],
    ['any', 'Enter', 'NumpadEnter', 'Enter'],
  ])('is named by what it types where that is Latin, a digit or a sign: %s %s', (_, key, code, name) => {
    expect(keyOf(press(key, { code }))).toBe(name);
  });

  it('is printed as on a keyboard', () => {
    expect(['p', 'ArrowLeft', ' ', 'Shift+Enter', 'Home'].map(printed)).toEqual([
      'P',
      '←',
      'Space',
      '⇧ ↵',
      'Home',
    ]);
  });

  const inspect = bindingsFor('inspect_full', maze);
  const meaning = (key: string, target: Element | null = null, more: Partial<KeyPress> = {}) =>
    match(press(key, more), target, inspect)?.command ?? null;

  it('means nothing with Ctrl, Alt or Meta, or while a character is composed', () => {
    expect(meaning('p')).toBe('pass');
    for (const held of ['ctrlKey', 'altKey', 'metaKey', 'isComposing'] as const) {
      expect(meaning('p', null, { [held]: true })).toBeNull();
    }
  });

  it('undoes a label with Ctrl or the command key and Z, also on a Russian keyboard, but not in a field', () => {
    const label = bindingsFor('label_lo', maze);
    const z = (more: Partial<KeyPress>, target: Element | null = null, key = 'z') =>
      match(press(key, { code: 'KeyZ', ...more }), target, label)?.command ?? null;
    expect([z({ ctrlKey: true }), z({ metaKey: true }), z({ ctrlKey: true }, null, 'я')]).toEqual([
      'clear',
      'clear',
      'clear',
    ]);
    expect([z({}), z({ ctrlKey: true, shiftKey: true }), z({ ctrlKey: true, altKey: true })]).toEqual([
      null,
      null,
      null,
    ]);
    document.body.innerHTML = '<input type="text">';
    expect(z({ ctrlKey: true }, document.body.querySelector('input'))).toBeNull();
    expect(printed('Ctrl+z')).toBe('Ctrl Z');
  });

  it('answers on a Russian keyboard, with default keys and with keys of one’s own', () => {
    expect(meaning('з', null, { code: 'KeyP' })).toBe('pass');
    const changed = remapped(inspect, { pass: keyOf(press('о', { code: 'KeyJ' })) });
    expect(match(press('о', { code: 'KeyJ' }), null, changed)?.command).toBe('pass');
    expect(match(press('j', { code: 'KeyJ' }), null, changed)?.command).toBe('pass'); // the layout is switched
  });

  it('belongs to a field while one is typed in', () => {
    document.body.innerHTML =
      '<input type="text"><textarea></textarea><p contenteditable><b>x</b></p><select></select>';
    for (const field of document.body.querySelectorAll('input, textarea, b, select')) {
      expect(meaning('p', field)).toBeNull();
    }
  });

  it('leaves arrows to a slider, and Enter and Space to a button or link', () => {
    document.body.innerHTML =
      '<input type="range"><button>b</button><a href="/x">a</a><button data-hotkeys>row</button>';
    const [slider, button, link, row] = [...document.body.children];
    expect(meaning('ArrowLeft', slider)).toBeNull();
    expect(meaning('p', slider)).toBe('pass');
    expect(meaning(' ', button)).toBeNull();
    expect(meaning(' ', link)).toBeNull();
    expect(meaning('p', button)).toBe('pass');
    expect(meaning(' ', row)).toBe('play');
  });
});

describe('listening', () => {
  const key = (name: string, more: KeyboardEventInit = {}): KeyboardEvent =>
    new KeyboardEvent('keydown', { key: name, bubbles: true, cancelable: true, ...more });

  it('runs commands, submits once however long the key is held, and is silent after it is stopped', () => {
    const run = vi.fn();
    const stop = listen(() => bindingsFor('inspect_full', maze), run);
    window.dispatchEvent(key('p'));
    window.dispatchEvent(key('p', { repeat: true }));
    window.dispatchEvent(key('ArrowRight'));
    window.dispatchEvent(key('ArrowRight', { repeat: true }));
    stop();
    window.dispatchEvent(key('p'));
    expect(run.mock.calls.flat()).toEqual(['pass', 'forward', 'forward']);
  });

  it('is silent while a dialog is open', () => {
    const run = vi.fn();
    const stop = listen(() => bindingsFor('inspect_full', maze), run);
    document.body.innerHTML = '<dialog open></dialog>';
    window.dispatchEvent(key('p'));
    stop();
    expect(run).not.toHaveBeenCalled();
  });
});
