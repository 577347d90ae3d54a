// The one list of keys: every mode, its keys, and what they do.
import { initial, readable } from '../api/names';
import { ANSWERABLE, type Vocabulary } from '../api/types';

/** What a key can do. `choose:2` labels with the vocabulary's third subgoal or action; `act:2` steps with its third action. */
export type Command =
  | 'help'
  | 'pass'
  | 'fail'
  | 'accept'
  | 'accept-rest'
  | 'done'
  | 'not-done'
  | 'first-wrong'
  | 'clear'
  | 'previous-segment'
  | 'next-segment'
  | 'skip'
  | 'undo'
  | 'play'
  | 'back'
  | 'forward'
  | 'back-5'
  | 'forward-5'
  | 'start'
  | 'end'
  | 'previous-stop'
  | 'next-stop'
  | 'slower'
  | 'faster'
  | 'reached'
  | 'send'
  | 'start-over'
  | `choose:${number}`
  | `act:${number}`;

export interface Binding {
  readonly command: Command;
  readonly keys: readonly string[]; // as `keyOf` names them; the first one is printed on the button
  readonly label: string;
  readonly group: Group;
  readonly once?: true; // ignored while the key repeats
}
type Group = 'Answer' | 'Player' | 'Task' | 'General';

/** Every mode: what is on the screen, which decides what the keys do. */
export const MODES = [...ANSWERABLE, 'hier_demo', 'flat_demo', 'waiting', 'feedback', 'between'] as const;
export type Mode = (typeof MODES)[number];

/** Return the bindings of a mode. If a subgoal or an action has the key of another command, that command loses the key. */
export function bindingsFor(mode: Mode, vocabulary: Vocabulary | null): Binding[] {
  const choices = vocabulary === null ? [] : choiceBindings(mode, vocabulary);
  const taken = new Set(choices.flatMap((binding) => binding.keys));
  const rest = [...answerBindings(mode), ...taskBindings(mode), HELP];
  const free = rest.map((binding) => ({
    ...binding,
    keys: binding.keys.filter((key) => !taken.has(key)),
  }));
  return [...choices, ...free.filter((binding) => binding.keys.length > 0)];
}

function taskBindings(mode: Mode): readonly Binding[] {
  if (mode === 'feedback' || mode === 'between') return [];
  if (mode === 'waiting') return [UNDO];
  return mode === 'hier_demo' || mode === 'flat_demo' ? TASK : [...TASK, ...PLAYER];
}

/** Return the keys that have two bindings. */
export function collisions(bindings: readonly Binding[]): string[] {
  const keys = bindings.flatMap((binding) => binding.keys);
  return [...new Set(keys.filter((key, index) => keys.indexOf(key) !== index))];
}

const HELP: Binding = { command: 'help', keys: ['?'], label: 'Show every key', group: 'General', once: true };
/** The bindings of every view. */
export const COMMON_BINDINGS: readonly Binding[] = [HELP];

const UNDO: Binding = {
  command: 'undo',
  keys: ['u'],
  label: 'Take back my last answer',
  group: 'Task',
  once: true,
};

const TASK: readonly Binding[] = [
  { command: 'skip', keys: ['s', 'Shift+s'], label: 'Skip, with a reason', group: 'Task', once: true },
  UNDO,
];

const PLAYER: readonly Binding[] = [
  { command: 'play', keys: [' '], label: 'Play or pause', group: 'Player', once: true },
  { command: 'back', keys: ['ArrowLeft', ','], label: 'One step back', group: 'Player' },
  { command: 'forward', keys: ['ArrowRight', '.'], label: 'One step forward', group: 'Player' },
  { command: 'back-5', keys: ['Shift+ArrowLeft'], label: 'Five steps back', group: 'Player' },
  { command: 'forward-5', keys: ['Shift+ArrowRight'], label: 'Five steps forward', group: 'Player' },
  { command: 'start', keys: ['Home'], label: 'To the start', group: 'Player' },
  { command: 'end', keys: ['End'], label: 'To the end', group: 'Player' },
  { command: 'previous-stop', keys: ['['], label: 'To the previous subgoal', group: 'Player' },
  { command: 'next-stop', keys: [']'], label: 'To the next subgoal', group: 'Player' },
  { command: 'slower', keys: ['-'], label: 'Slower', group: 'Player' },
  { command: 'faster', keys: ['=', '+'], label: 'Faster', group: 'Player' },
];

/** The bindings of a view where a trajectory is only watched. */
export const WATCH_BINDINGS: readonly Binding[] = [...PLAYER, HELP];

const ACCEPT: readonly Binding[] = [
  {
    command: 'accept',
    keys: ['Enter'],
    label: "Keep the learner's choice; when nothing is left, submit",
    group: 'Answer',
    once: true,
  },
  {
    command: 'accept-rest',
    keys: ['Shift+Enter'],
    label: 'Keep all remaining choices of the learner and submit',
    group: 'Answer',
    once: true,
  },
  { command: 'clear', keys: ['Backspace'], label: 'Undo the last label', group: 'Answer' },
];

const DEMO: readonly Binding[] = [
  { command: 'send', keys: ['Shift+Enter'], label: 'Send the demonstration', group: 'Answer', once: true },
  { command: 'clear', keys: ['Backspace'], label: 'Undo the last move', group: 'Answer' },
  {
    command: 'start-over',
    keys: ['Shift+Backspace'],
    label: 'Start over; this can be undone',
    group: 'Answer',
    once: true,
  },
];

function answerBindings(mode: Mode): readonly Binding[] {
  switch (mode) {
    case 'inspect_full':
    case 'inspect_lo':
      return [
        { command: 'pass', keys: ['p'], label: 'Pass', group: 'Answer', once: true },
        { command: 'fail', keys: ['f'], label: 'Fail', group: 'Answer', once: true },
      ];
    case 'label_hi':
      return [
        ...ACCEPT,
        { command: 'previous-segment', keys: ['ArrowUp'], label: 'Previous segment', group: 'Answer' },
        { command: 'next-segment', keys: ['ArrowDown'], label: 'Next segment', group: 'Answer' },
      ];
    case 'label_lo':
      return [
        ...ACCEPT,
        {
          command: 'first-wrong',
          keys: ['x'],
          label: 'First wrong step: all steps before it are right',
          group: 'Answer',
          once: true,
        },
        {
          command: 'done',
          keys: ['d'],
          label: 'Done here: the segment should end at this state',
          group: 'Answer',
          once: true,
        },
        {
          command: 'not-done',
          keys: ['n'],
          label: 'Not done, even at the last state',
          group: 'Answer',
          once: true,
        },
      ];
    case 'label_full':
      return [
        ...ACCEPT,
        {
          command: 'first-wrong',
          keys: ['x'],
          label: 'First wrong step: all steps before it are right',
          group: 'Answer',
          once: true,
        },
      ];
    case 'hier_demo':
      return [
        {
          command: 'reached',
          keys: ['Enter', 'd'],
          label: 'The subgoal is reached; after the episode, send the demonstration',
          group: 'Answer',
          once: true,
        },
        ...DEMO,
      ];
    case 'flat_demo':
      return DEMO.map((one) => (one.command === 'send' ? { ...one, keys: ['Enter', ...one.keys] } : one));
    case 'waiting':
      return [];
    case 'feedback':
      return [
        { command: 'accept', keys: ['Enter'], label: 'Next query', group: 'Answer', once: true },
        { command: 'undo', keys: ['u'], label: 'Answer this query again', group: 'Answer', once: true },
        { command: 'previous-segment', keys: ['ArrowUp'], label: 'Previous label', group: 'Answer' },
        { command: 'next-segment', keys: ['ArrowDown'], label: 'Next label', group: 'Answer' },
      ];
    case 'between':
      return [{ command: 'accept', keys: ['Enter'], label: 'Start practicing', group: 'Answer', once: true }];
  }
}

const ARROWS: Readonly<Record<string, string>> = {
  up: 'ArrowUp',
  down: 'ArrowDown',
  left: 'ArrowLeft',
  right: 'ArrowRight',
};
/** The usual keys of a game, in demonstrations. A label's player uses them otherwise. */
const GAME_KEYS: Readonly<Record<string, string>> = {
  ...ARROWS,
  jump: ' ',
  fire: ' ',
  jump_left: 'Shift+ArrowLeft',
  jump_right: 'Shift+ArrowRight',
  jump_up: 'Shift+ArrowUp',
  jump_down: 'Shift+ArrowDown',
};
const DIGITS = '1234567890';

function choiceBindings(mode: Mode, vocabulary: Vocabulary): Binding[] {
  if (mode === 'label_hi') {
    const reserved = new Set([...answerBindings(mode), UNDO, HELP].flatMap((binding) => binding.keys));
    return subgoalBindings(vocabulary.subgoals, reserved);
  }
  if (mode === 'hier_demo' || mode === 'flat_demo') return demoBindings(mode, vocabulary);
  if (mode === 'label_lo' || mode === 'label_full') {
    return vocabulary.actions.map((name, index) => choice(name, index, ARROWS[name.toLowerCase()]));
  }
  return [];
}

/** Each action has the usual key of a game or a letter, each subgoal a digit and perhaps a letter. In a flat demonstration, actions also have digits. */
function demoBindings(mode: 'hier_demo' | 'flat_demo', { subgoals, actions }: Vocabulary): Binding[] {
  const taken = new Set([...answerBindings(mode), UNDO, HELP].flatMap((binding) => binding.keys));
  const moves = actions.map((name, index): Binding => {
    const usual = GAME_KEYS[name.toLowerCase()];
    const key = usual !== undefined && !taken.has(usual) ? usual : freeLetter(name, taken);
    if (key !== undefined) taken.add(key);
    const digit = mode === 'flat_demo' ? DIGITS[index] : undefined;
    const keys = [key, digit].filter((one) => one !== undefined);
    return { command: `act:${index}`, keys, label: readable(name), group: 'Answer' };
  });
  return mode === 'flat_demo' ? moves : [...subgoalBindings(subgoals, taken), ...moves];
}

function freeLetter(name: string, taken: ReadonlySet<string>): string | undefined {
  const candidates = `${initial(name)}${name}abcdefghijklmnopqrstuvwxyz`.toLowerCase();
  return Array.from(candidates).find((letter) => /[a-z]/.test(letter) && !taken.has(letter));
}

/** Each subgoal has a digit. It also has its initial, if that key is free and no other subgoal has the same initial. */
function subgoalBindings(subgoals: readonly string[], reserved: ReadonlySet<string>): Binding[] {
  const initials = subgoals.map((name) => initial(name).toLowerCase());
  return subgoals.map((name, index) => {
    const letter = initials[index] ?? '';
    const unique = initials.indexOf(letter) === initials.lastIndexOf(letter);
    return choice(
      name,
      index,
      unique && /^[a-z]$/.test(letter) && !reserved.has(letter) ? letter : undefined,
    );
  });
}

function choice(name: string, index: number, key: string | undefined): Binding {
  const digit = DIGITS[index];
  const keys = [key, digit].filter((one) => one !== undefined);
  return { command: `choose:${index}`, keys, label: readable(name), group: 'Answer' };
}
