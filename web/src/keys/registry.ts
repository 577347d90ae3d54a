// The one list of keys: every mode, its keys, and what they do.
import { initial, readable } from '../api/names';
import { ANSWERABLE, type Vocabulary } from '../api/types';

/** What a key can do. `choose:2` labels with the vocabulary's third subgoal or action; `act:2` steps with its third action. */
export type Command =
  | 'help'
  | 'find'
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
  | 'leave'
  | 'next-answer'
  | 'previous-answer'
  | 'comment'
  | 'send-back'
  | `choose:${number}`
  | `act:${number}`;

export interface Binding {
  readonly command: Command;
  readonly keys: readonly string[]; // as `keyOf` names them; the first one is printed on the button
  readonly label: string;
  readonly group: Group;
  readonly once?: true; // ignored while the key repeats
}
type Group = 'Answer' | 'Review' | 'Player' | 'Task' | 'General';

/** Every mode: what is on the screen, which decides what the keys do. */
export const MODES = [
  ...ANSWERABLE,
  'hier_demo',
  'flat_demo',
  'waiting',
  'feedback',
  'example',
  'between',
  'review',
] as const;
export type Mode = (typeof MODES)[number];

/** Return the bindings of a mode. If a subgoal or an action has the key of another command, that command loses the key. */
export function bindingsFor(mode: Mode, vocabulary: Vocabulary | null): Binding[] {
  const choices = vocabulary === null ? [] : choiceBindings(mode, vocabulary);
  const taken = new Set(choices.flatMap((binding) => binding.keys));
  const rest = [...answerBindings(mode), ...taskBindings(mode), ...COMMON_BINDINGS];
  const free = rest.map((binding) => ({
    ...binding,
    keys: binding.keys.filter((key) => !taken.has(key)),
  }));
  return [...choices, ...free.filter((binding) => binding.keys.length > 0)];
}

function taskBindings(mode: Mode): readonly Binding[] {
  if (mode === 'feedback' || mode === 'example' || mode === 'between') return [];
  if (mode === 'waiting') return [UNDO];
  if (mode === 'review') return PLAYER;
  return mode === 'hier_demo' || mode === 'flat_demo' ? TASK : [...TASK, ...PLAYER];
}

/** Return the keys that have two bindings. */
export function collisions(bindings: readonly Binding[]): string[] {
  const keys = bindings.flatMap((binding) => binding.keys);
  return [...new Set(keys.filter((key, index) => keys.indexOf(key) !== index))];
}

const HELP: Binding = { command: 'help', keys: ['?'], label: 'Show every key', group: 'General', once: true };
const FIND: Binding = {
  command: 'find',
  keys: ['Ctrl+k'],
  label: 'Find a view, a run or a command',
  group: 'General',
  once: true,
};
/** The bindings of every view. */
export const COMMON_BINDINGS: readonly Binding[] = [HELP, FIND];

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

/** The binding that leaves the first practice, whatever it shows. */
export const LEAVE: Binding = {
  command: 'leave',
  keys: ['Escape'],
  label: 'Skip the practice',
  group: 'General',
  once: true,
};

/** The bindings of a view where a trajectory is only watched. */
export const WATCH_BINDINGS: readonly Binding[] = [...PLAYER, ...COMMON_BINDINGS];

const REVIEW: readonly Binding[] = [
  { command: 'next-answer', keys: ['j', 'ArrowDown'], label: 'Next answer, an older one', group: 'Review' },
  {
    command: 'previous-answer',
    keys: ['k', 'ArrowUp'],
    label: 'Previous answer, a newer one',
    group: 'Review',
  },
  { command: 'comment', keys: ['c'], label: 'Write a comment', group: 'Review', once: true },
  {
    command: 'send-back',
    keys: ['b'],
    label: 'Send the answer back with the comment',
    group: 'Review',
    once: true,
  },
];

const ACCEPT: readonly Binding[] = [
  {
    command: 'accept',
    keys: ['Enter'],
    label: "Keep the learner's choice; when nothing is left, send the answer",
    group: 'Answer',
    once: true,
  },
  {
    command: 'accept-rest',
    keys: ['Shift+Enter'],
    label: 'Keep all remaining choices of the learner and send the answer',
    group: 'Answer',
    once: true,
  },
  { command: 'clear', keys: ['Backspace', 'Ctrl+z'], label: 'Undo the last label', group: 'Answer' },
];

const DEMO: readonly Binding[] = [
  { command: 'send', keys: ['Shift+Enter'], label: 'Send the demonstration', group: 'Answer', once: true },
  { command: 'clear', keys: ['Backspace', 'Ctrl+z'], label: 'Undo the last move', group: 'Answer' },
  {
    command: 'start-over',
    keys: ['Shift+Backspace'],
    label: 'Start over; this can be undone',
    group: 'Answer',
    once: true,
  },
];

/** Look at the labels of an answer, one by one. */
const LOOK: readonly Binding[] = [
  { command: 'previous-segment', keys: ['ArrowUp'], label: 'Previous label', group: 'Answer' },
  { command: 'next-segment', keys: ['ArrowDown'], label: 'Next label', group: 'Answer' },
];

function answerBindings(mode: Mode): readonly Binding[] {
  switch (mode) {
    case 'inspect_full':
    case 'inspect_lo':
      return [
        { command: 'pass', keys: ['y', 'p'], label: 'Yes, it worked', group: 'Answer', once: true },
        { command: 'fail', keys: ['n', 'f'], label: 'No, it failed', group: 'Answer', once: true },
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
        { command: 'accept', keys: ['Enter'], label: 'Next question', group: 'Answer', once: true },
        { command: 'undo', keys: ['u'], label: 'Answer this question again', group: 'Answer', once: true },
        ...LOOK,
      ];
    case 'example':
      return [
        { command: 'accept', keys: ['Enter'], label: 'Now try one yourself', group: 'Answer', once: true },
        ...LOOK,
      ];
    case 'review':
      return REVIEW;
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
/** The usual keys of a game. They work in demonstrations; elsewhere, the player uses them. */
const GAME_KEYS: Readonly<Record<string, string>> = {
  jump: ' ',
  fire: ' ',
  jump_left: 'Shift+ArrowLeft',
  jump_right: 'Shift+ArrowRight',
  jump_up: 'Shift+ArrowUp',
  jump_down: 'Shift+ArrowDown',
};
const DIGITS = '1234567890';
/** The modes in which subgoals are chosen, and those in which actions are. */
const OF_SUBGOALS: readonly Mode[] = ['label_hi', 'hier_demo'];
const OF_ACTIONS: readonly Mode[] = ['label_lo', 'label_full', 'hier_demo', 'flat_demo'];

function choiceBindings(mode: Mode, vocabulary: Vocabulary): Binding[] {
  if (!OF_SUBGOALS.includes(mode) && !OF_ACTIONS.includes(mode)) return [];
  const { subgoals, actions } = namesToKeys(vocabulary);
  const chosen = subgoals.map((key, index) =>
    choice(`choose:${index}`, vocabulary.subgoals[index] ?? '', [key, DIGITS[index]]),
  );
  if (mode === 'label_hi') return chosen;
  const isDemo = mode === 'hier_demo' || mode === 'flat_demo';
  const moves = actions.map((key, index) => {
    const name = vocabulary.actions[index] ?? '';
    const digit = mode === 'hier_demo' ? undefined : DIGITS[index]; // there, subgoals have the digits
    const usual = isDemo ? GAME_KEYS[name.toLowerCase()] : undefined;
    const isFirst = vocabulary.actions.findIndex((one) => GAME_KEYS[one.toLowerCase()] === usual) === index;
    return choice(`${isDemo ? 'act' : 'choose'}:${index}`, name, [key, isFirst ? usual : undefined, digit]);
  });
  return mode === 'hier_demo' ? [...chosen, ...moves] : moves;
}

/**
 * Return the key of each subgoal and action: the same in every mode, so that a hand can learn it. A subgoal has its
 * initial, if that is free and no other subgoal has it. An action has the arrow of its direction, or a letter.
 */
function namesToKeys(vocabulary: Vocabulary): Record<'subgoals' | 'actions', (string | undefined)[]> {
  const usedIn = (modes: readonly Mode[]): Set<string> =>
    new Set([...modes.flatMap(answerBindings), UNDO, ...COMMON_BINDINGS].flatMap((binding) => binding.keys));
  const reserved = usedIn(OF_SUBGOALS);
  const initials = vocabulary.subgoals.map((name) => initial(name).toLowerCase());
  const subgoals = initials.map((letter) => {
    const unique = initials.indexOf(letter) === initials.lastIndexOf(letter);
    return unique && /^[a-z]$/.test(letter) && !reserved.has(letter) ? letter : undefined;
  });
  const taken = usedIn(OF_ACTIONS);
  for (const key of subgoals) if (key !== undefined) taken.add(key);
  const actions = vocabulary.actions.map((name) => {
    const arrow = ARROWS[name.toLowerCase()];
    const key = arrow !== undefined && !taken.has(arrow) ? arrow : freeLetter(name, taken);
    if (key !== undefined) taken.add(key);
    return key;
  });
  return { subgoals, actions };
}

function freeLetter(name: string, taken: ReadonlySet<string>): string | undefined {
  const candidates = `${initial(name)}${name}abcdefghijklmnopqrstuvwxyz`.toLowerCase();
  return Array.from(candidates).find((letter) => /[a-z]/.test(letter) && !taken.has(letter));
}

function choice(command: Command, name: string, keys: readonly (string | undefined)[]): Binding {
  return { command, keys: keys.filter((one) => one !== undefined), label: readable(name), group: 'Answer' };
}
