import { readdirSync, readFileSync } from 'node:fs';
import PO from 'pofile';
import { describe, expect, it } from 'vitest';
import { IndexTracker } from 'wuchale';
import config from '../../wuchale.config.js';
import { LANGUAGES } from './language';

const ABOUT = 'Run `npm run texts` in web/, then translate: CONTRIBUTING.md';
const SOURCES = readdirSync('src', { recursive: true, encoding: 'utf8' })
  .filter((name) => /\.(ts|svelte)$/.test(name) && !/\.(test|d)\.ts$/.test(name))
  .map((name) => `src/${name}`);

/** Return a source as the build makes it: its texts are references to the catalogue. */
async function built(filename: string): Promise<string> {
  const content = readFileSync(filename, 'utf8');
  const where = { index: new IndexTracker(), expr: { plain: '', reactive: '' }, matchUrl: () => null };
  const { output } = await config.adapters.main.transform({ content, filename, ...where });
  return output('').code ?? content;
}

it('every language of the page has a catalogue', () => {
  expect(config.locales).toEqual([...LANGUAGES]);
});

describe.each(LANGUAGES)('the catalogue of %s', (language) => {
  const { items } = PO.parse(readFileSync(`src/language/${language}.po`, 'utf8'));

  it('has every text of the page, and no other', () => {
    const untranslated = items.filter(({ msgstr }) => msgstr.length === 0 || msgstr.includes(''));
    expect(
      untranslated.map(({ msgid }) => msgid),
      ABOUT,
    ).toEqual([]);
    expect(
      items.filter(({ obsolete }) => obsolete).map(({ msgid }) => msgid),
      ABOUT,
    ).toEqual([]);
  });
});

it('the build finds every marked text', async () => {
  const marked = /(?<![\w.#$])(?:t\(\s*['"`]|count\([^;]*?, \[\s*['"]).*/g;
  const left = await Promise.all(
    SOURCES.map(async (name) => (await built(name)).match(marked)?.map((text) => `${name}: ${text}`) ?? []),
  );
  expect(left.flat(), 'The build does not look there: mark the text elsewhere').toEqual([]);
});
