// The one list of keys: every mode, its keys, and what they do.
import { initial, readable } from '../api/names';
import { ANSWERABLE, type Vocabulary } from '../api/types';
import { t } from '../language/language';

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
  readonly group: string; // of the help, as people read it
  readonly once?: true; // ignored while the key repeats
}

/** Every mode: what is on the screen, which decides what the keys do. */
export const MODES = [
  ...ANSWERABLE,
  'hier_demo',
  'play_on', // a demonstration that begins where the learner failed: what it did can be looked at
  'flat_demo',
  'waiting',
  'feedback',
  'example',
  'shown_demo', // a demonstration as a worked example
  'between',
  'review',
] as const;
export type Mode = (typeof MODES)[number];

/** Return the bindings of a mode. If a subgoal or an action has the key of another command, that command loses the key. */
export function bindingsFor(mode: Mode, vocabulary: Vocabulary | null): Binding[] {
  const choices = vocabulary === null ? [] : choiceBindings(mode, vocabulary);
  const taken = new Set(choices.flatMap((binding) => binding.keys));
  const rest = [...answerBindings(mode), ...taskBindings(mode), ...commonBindings()];
  const free = rest.map((binding) => ({
    ...binding,
    keys: binding.keys.filter((key) => !taken.has(key)),
  }));
  return [...choices, ...free.filter((binding) => binding.keys.length > 0)];
}

function taskBindings(mode: Mode): readonly Binding[] {
  if (mode === 'feedback' || mode === 'example' || mode === 'between') return [];
  if (mode === 'shown_demo') return player().filter(({ command }) => command === 'play');
  if (mode === 'waiting') return [undo()];
  if (mode === 'review') return player();
  return mode === 'hier_demo' || mode === 'flat_demo' ? task() : [...task(), ...player()];
}

/** Return the keys that have two bindings. */
export function collisions(bindings: readonly Binding[]): string[] {
  const keys = bindings.flatMap((binding) => binding.keys);
  return [...new Set(keys.filter((key, index) => keys.indexOf(key) !== index))];
}

const help = (): Binding => ({
  command: 'help',
  keys: ['?'],
  label: t('Show every key'),
  group: t('General'),
  once: true,
});
const find = (): Binding => ({
  command: 'find',
  keys: ['Ctrl+k'],
  label: t('Find a view, a run or a command'),
  group: t('General'),
  once: true,
});
/** The bindings of every view. */
export const commonBindings = (): readonly Binding[] => [help(), find()];

const undo = (): Binding => ({
  command: 'undo',
  keys: ['u'],
  label: t('Take back my last answer'),
  group: t('Task'),
  once: true,
});

const task = (): readonly Binding[] => [
  { command: 'skip', keys: ['s', 'Shift+s'], label: t('Skip, with a reason'), group: t('Task'), once: true },
  undo(),
];

const player = (): readonly Binding[] => [
  { command: 'play', keys: [' '], label: t('Play or pause'), group: t('Player'), once: true },
  { command: 'back', keys: ['ArrowLeft', ','], label: t('One step back'), group: t('Player') },
  { command: 'forward', keys: ['ArrowRight', '.'], label: t('One step forward'), group: t('Player') },
  { command: 'back-5', keys: ['Shift+ArrowLeft'], label: t('Five steps back'), group: t('Player') },
  { command: 'forward-5', keys: ['Shift+ArrowRight'], label: t('Five steps forward'), group: t('Player') },
  { command: 'start', keys: ['Home'], label: t('To the start'), group: t('Player') },
  { command: 'end', keys: ['End'], label: t('To the end'), group: t('Player') },
  { command: 'previous-stop', keys: ['['], label: t('To the previous subgoal'), group: t('Player') },
  { command: 'next-stop', keys: [']'], label: t('To the next subgoal'), group: t('Player') },
  { command: 'slower', keys: ['-'], label: t('Slower'), group: t('Player') },
  { command: 'faster', keys: ['=', '+'], label: t('Faster'), group: t('Player') },
];

/** The binding that leaves the first practice, whatever it shows. */
export const leave = (): Binding => ({
  command: 'leave',
  keys: ['Escape'],
  label: t('Skip the practice'),
  group: t('General'),
  once: true,
});

/** The bindings of a view where a trajectory is only watched. */
export const watchBindings = (): readonly Binding[] => [...player(), ...commonBindings()];

const review = (): readonly Binding[] => [
  {
    command: 'next-answer',
    keys: ['j', 'ArrowDown'],
    label: t('Next answer, an older one'),
    group: t('Review'),
  },
  {
    command: 'previous-answer',
    keys: ['k', 'ArrowUp'],
    label: t('Previous answer, a newer one'),
    group: t('Review'),
  },
  { command: 'comment', keys: ['c'], label: t('Write a comment'), group: t('Review'), once: true },
  {
    command: 'send-back',
    keys: ['b'],
    label: t('Send the answer back with the comment'),
    group: t('Review'),
    once: true,
  },
];

const accept = (): readonly Binding[] => [
  {
    command: 'accept',
    keys: ['Enter'],
    label: t("Keep the learner's choice; when nothing is left, send the answer"),
    group: t('Answer'),
    once: true,
  },
  {
    command: 'accept-rest',
    keys: ['Shift+Enter'],
    label: t('Keep all remaining choices of the learner and send the answer'),
    group: t('Answer'),
    once: true,
  },
  { command: 'clear', keys: ['Backspace', 'Ctrl+z'], label: t('Undo the last label'), group: t('Answer') },
];

const demo = (): readonly Binding[] => [
  {
    command: 'send',
    keys: ['Shift+Enter'],
    label: t('Send the demonstration'),
    group: t('Answer'),
    once: true,
  },
  { command: 'clear', keys: ['Backspace', 'Ctrl+z'], label: t('Undo the last move'), group: t('Answer') },
  {
    command: 'start-over',
    keys: ['Shift+Backspace'],
    label: t('Start over; this can be undone'),
    group: t('Answer'),
    once: true,
  },
];

/** Look at the labels of an answer, one by one. */
const look = (): readonly Binding[] => [
  { command: 'previous-segment', keys: ['ArrowUp'], label: t('Previous label'), group: t('Answer') },
  { command: 'next-segment', keys: ['ArrowDown'], label: t('Next label'), group: t('Answer') },
];

function answerBindings(mode: Mode): readonly Binding[] {
  switch (mode) {
    case 'inspect_full':
    case 'inspect_lo':
      return [
        { command: 'pass', keys: ['y', 'p'], label: t('Yes, it worked'), group: t('Answer'), once: true },
        { command: 'fail', keys: ['n', 'f'], label: t('No, it failed'), group: t('Answer'), once: true },
      ];
    case 'label_hi':
      return [
        ...accept(),
        { command: 'previous-segment', keys: ['ArrowUp'], label: t('Previous segment'), group: t('Answer') },
        { command: 'next-segment', keys: ['ArrowDown'], label: t('Next segment'), group: t('Answer') },
      ];
    case 'label_lo':
      return [
        ...accept(),
        {
          command: 'first-wrong',
          keys: ['x'],
          label: t('First wrong step: all steps before it are right'),
          group: t('Answer'),
          once: true,
        },
        {
          command: 'done',
          keys: ['d'],
          label: t('Done here: the segment should end at this state'),
          group: t('Answer'),
          once: true,
        },
        {
          command: 'not-done',
          keys: ['n'],
          label: t('Not done, even at the last state'),
          group: t('Answer'),
          once: true,
        },
      ];
    case 'label_full':
      return [
        ...accept(),
        {
          command: 'first-wrong',
          keys: ['x'],
          label: t('First wrong step: all steps before it are right'),
          group: t('Answer'),
          once: true,
        },
      ];
    case 'hier_demo':
    case 'play_on':
      return [
        {
          command: 'reached',
          keys: ['Enter', 'd'],
          label: t('The subgoal is reached; after the episode, send the demonstration'),
          group: t('Answer'),
          once: true,
        },
        ...demo(),
      ];
    case 'flat_demo':
      return demo().map((one) => (one.command === 'send' ? { ...one, keys: ['Enter', ...one.keys] } : one));
    case 'waiting':
      return [];
    case 'feedback':
      return [
        { command: 'accept', keys: ['Enter'], label: t('Next question'), group: t('Answer'), once: true },
        {
          command: 'undo',
          keys: ['u'],
          label: t('Answer this question again'),
          group: t('Answer'),
          once: true,
        },
        ...look(),
      ];
    case 'example':
      return [
        {
          command: 'accept',
          keys: ['Enter'],
          label: t('Now try one yourself'),
          group: t('Answer'),
          once: true,
        },
        ...look(),
      ];
    case 'shown_demo':
      return [
        { command: 'accept', keys: ['Enter'], label: t('Go on'), group: t('Answer'), once: true },
        { command: 'previous-segment', keys: ['ArrowUp'], label: t('Previous row'), group: t('Answer') },
        { command: 'next-segment', keys: ['ArrowDown'], label: t('Next row'), group: t('Answer') },
      ];
    case 'review':
      return review();
    case 'between':
      return [
        { command: 'accept', keys: ['Enter'], label: t('Start practicing'), group: t('Answer'), once: true },
      ];
  }
}

const ARROWS: Readonly<Record<string, string>> = {
  up: 'ArrowUp',
  north: 'ArrowUp',
  down: 'ArrowDown',
  south: 'ArrowDown',
  left: 'ArrowLeft',
  west: 'ArrowLeft',
  right: 'ArrowRight',
  east: 'ArrowRight',
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
const OF_SUBGOALS: readonly Mode[] = ['label_hi', 'hier_demo', 'play_on'];
const OF_ACTIONS: readonly Mode[] = ['label_lo', 'label_full', 'hier_demo', 'play_on', 'flat_demo'];

function choiceBindings(mode: Mode, vocabulary: Vocabulary): Binding[] {
  if (!OF_SUBGOALS.includes(mode) && !OF_ACTIONS.includes(mode)) return [];
  const { subgoals, actions } = namesToKeys(vocabulary);
  const chosen = subgoals.map((key, index) =>
    choice(`choose:${index}`, vocabulary.subgoals[index] ?? '', [key, DIGITS[index]]),
  );
  if (mode === 'label_hi') return chosen;
  const isHierarchical = mode === 'hier_demo' || mode === 'play_on';
  const isDemo = isHierarchical || mode === 'flat_demo';
  const moves = actions.map((key, index) => {
    const name = vocabulary.actions[index] ?? '';
    const digit = isHierarchical ? undefined : DIGITS[index]; // there, subgoals have the digits
    const usual = isDemo ? GAME_KEYS[name.toLowerCase()] : undefined;
    const isFirst = vocabulary.actions.findIndex((one) => GAME_KEYS[one.toLowerCase()] === usual) === index;
    return choice(`${isDemo ? 'act' : 'choose'}:${index}`, name, [key, isFirst ? usual : undefined, digit]);
  });
  return isHierarchical ? [...chosen, ...moves] : moves;
}

/** Return the key that is printed on the button of a subgoal: its letter, else its digit; undefined if it has none. */
export function keyOfSubgoal(index: number, subgoals: readonly string[]): string | undefined {
  return lettersOf(subgoals)[index] ?? DIGITS[index];
}

/** Return the letter of each subgoal: its initial, if that is free and no other subgoal has it. */
function lettersOf(subgoals: readonly string[]): (string | undefined)[] {
  reserved ??= usedIn(OF_SUBGOALS);
  const initials = subgoals.map((name) => initial(name).toLowerCase());
  return initials.map((letter) => {
    const unique = initials.indexOf(letter) === initials.lastIndexOf(letter);
    return unique && /^[a-z]$/.test(letter) && !reserved?.has(letter) ? letter : undefined;
  });
}

let reserved: ReadonlySet<string> | undefined; // computed once, because a picture draws many tags

/** Return the keys in these modes that belong to no subgoal or action. */
function usedIn(modes: readonly Mode[]): Set<string> {
  return new Set(
    [...modes.flatMap(answerBindings), undo(), ...commonBindings()].flatMap((binding) => binding.keys),
  );
}

/**
 * Return the key of each subgoal and action: the same in every mode, so that a hand can learn it. A subgoal has its
 * letter. An action has the arrow of its direction, or a letter.
 */
function namesToKeys(vocabulary: Vocabulary): Record<'subgoals' | 'actions', (string | undefined)[]> {
  const subgoals = lettersOf(vocabulary.subgoals);
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
  return {
    command,
    keys: keys.filter((one) => one !== undefined),
    label: readable(name),
    group: t('Answer'),
  };
}
