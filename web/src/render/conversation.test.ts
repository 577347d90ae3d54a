import { describe, expect, it } from 'vitest';
import type { Json } from '../api/types';
import { conversationOf, frameOfTurn, newTurns, type Conversation } from './conversation';

const asked = {
  turns: [
    { speaker: 'user', text: 'I need a flight.' },
    { speaker: 'system', text: 'Where to?' },
  ],
  known: {},
};
const told = {
  turns: [...asked.turns, { speaker: 'user', text: 'To Rome.' }],
  known: { city: 'Rome', day: 'Friday' },
  flights_left: 2,
  accepted: false,
  end: null,
};

const read = (view: Json): Conversation => {
  const found = conversationOf(view);
  if (found === null) throw new Error('no conversation');
  return found;
};

describe('a state with a list of turns', () => {
  it('is a conversation with its speakers, and the rest of the state in words', () => {
    expect(conversationOf(told)).toEqual({
      turns: told.turns,
      rest: [
        ['known', 'city Rome, day Friday'],
        ['flights left', '2'],
        ['accepted', 'no'],
        ['end', '—'],
      ],
    });
  });

  it('may have turns that are only texts', () => {
    expect(conversationOf({ turns: ['Hello.', { text: 'Goodbye.' }] })?.turns).toEqual([
      { speaker: null, text: 'Hello.' },
      { speaker: null, text: 'Goodbye.' },
    ]);
  });

  it('shows which state a turn was new in', () => {
    expect([0, 1, 2].map((turn) => frameOfTurn([asked, asked, told], turn))).toEqual([0, 0, 2]);
  });

  it('says which turns are new since the state before', () => {
    const [before, now, other] = [read(asked), read(told), read({ turns: ['Hello.'] })];
    expect(newTurns(now, before)).toBe(1);
    expect(newTurns(before, before)).toBe(0);
    expect(newTurns(before, null)).toBe(0); // in the first state, nothing is new
    expect(newTurns(other, before)).toBe(1);
  });
});

describe('a state with a text', () => {
  it('is a conversation of one turn', () => {
    expect(conversationOf({ text: 'You are in a kitchen.', score: 3, items: ['lamp', 'key'] })).toEqual({
      turns: [{ speaker: null, text: 'You are in a kitchen.' }],
      rest: [
        ['score', '3'],
        ['items', 'lamp, key'],
      ],
    });
  });

  it('keeps turns that are none', () => {
    expect(conversationOf({ text: 'Move 3.', turns: 3 })?.rest).toEqual([['turns', '3']]);
  });
});

describe('any other state', () => {
  it.each([
    [undefined],
    [null],
    [4],
    ['text'],
    [[1, 2]],
    [{}],
    [{ turns: 4 }],
    [{ turns: [{ speaker: 'a' }] }],
    [{ text: 7 }],
  ])('is no conversation: %j', (view) => expect(conversationOf(view)).toBeNull());
});
