import { expect, test } from 'vitest';
import { textOf } from './text';

test('a string is shown as it is, with its line breaks', () => {
  expect(textOf('User: "hello"\nAgent: hi')).toBe('User: "hello"\nAgent: hi');
});

test.each([[''], [null], [{}], [[]]])('nothing is shown of %j', (value) => {
  expect(textOf(value)).toBeNull();
});

test('everything else is indented, and what is plain and short has one line', () => {
  expect(textOf(0)).toBe('0');
  expect(textOf([3, 4])).toBe('[3, 4]');
  expect(textOf({ agent: [3, 4], 'its key': null, room: { doors: [], lit: true } })).toBe(
    '{\n  "agent": [3, 4],\n  "its key": null,\n  "room": {\n    "doors": [],\n    "lit": true\n  }\n}',
  );
  const long = Array.from({ length: 40 }, (_, index) => index);
  expect(textOf(long)?.split('\n')).toHaveLength(42);
  expect(JSON.parse(textOf({ long, deep: [[1], { a: ['b'] }] }) ?? '')).toEqual({
    long,
    deep: [[1], { a: ['b'] }],
  });
});
