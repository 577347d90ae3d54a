import { expect, test } from 'vitest';
import { inOurWords, translated } from './wordings';
import WORDINGS from './wordings.json';

test('in English, every standard wording is said as it is', () => {
  expect(translated('{}')).toEqual(WORDINGS);
});

test.each(Object.values(WORDINGS))('the wording is known: %s', (wording) => {
  const text = wording.replace('{}', 'go “to” target');
  expect(inOurWords(text)).toBe(text);
});

test.each(['', 'Is the cube in the box?', 'It tried “east”. Did that work well?', 'It tried “'])(
  'words of somebody else are left as they are: %j',
  (text) => expect(inOurWords(text)).toBe(text),
);
