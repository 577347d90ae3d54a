import { expect, it } from 'vitest';
import { languageOf, localeOf, rememberedLanguage, rememberLanguage } from './language';

it.each([
  ['German', ['de-DE', 'de', 'en'], 'de'],
  ['a region of German', ['de-CH'], 'de'],
  ['the first one that the page has', ['fr', 'de', 'en-US'], 'de'],
  ['English before German', ['en-GB', 'de'], 'en'],
  ['a language that the page lacks', ['ja', 'fr-FR'], 'en'],
  ['none', [], 'en'],
] as const)('a browser that prefers %s gets it, else English', (_, preferred, language) => {
  expect(languageOf(preferred)).toBe(language);
});

it('numbers and dates are those of the region that the browser names', () => {
  expect(localeOf('de', ['fr', 'de-AT', 'de'])).toBe('de-AT');
  expect(localeOf('en', ['fr', 'en-US'])).toBe('en-US');
  expect([localeOf('de', ['fr']), localeOf('en', ['fr'])]).toEqual(['de', 'en-GB']);
});

it('remembers the choice of a person until it is taken back', () => {
  const kept = new Map<string, string>();
  const storage = {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => void kept.set(key, value),
    removeItem: (key: string) => void kept.delete(key),
  };
  expect(rememberedLanguage(storage)).toBeNull();
  rememberLanguage(storage, 'de');
  expect(rememberedLanguage(storage)).toBe('de');
  rememberLanguage(storage, null);
  expect(rememberedLanguage(storage)).toBeNull();
});

it('a storage that is off, or that contains another word, changes nothing', () => {
  const off = (): never => {
    throw new Error('off');
  };
  expect(rememberedLanguage({ getItem: off })).toBeNull();
  expect(rememberedLanguage({ getItem: () => 'xx' })).toBeNull();
  expect(() => rememberLanguage({ setItem: off, removeItem: off }, 'de')).not.toThrow();
});
