// The texts of the page. The build makes every module with a text ask here for the catalogue of the page's language.
import toRuntime, { type CatalogModule, type Runtime } from 'wuchale/runtime';
import { language } from './language';

// English is a part of the page; the catalogue of another language is loaded if the page has this language.
const ENGLISH = import.meta.glob<CatalogModule>('./.wuchale/main.main.en.compiled.js', { eager: true });
const OTHERS = import.meta.glob<CatalogModule>([
  './.wuchale/main.main.*.compiled.js',
  '!./.wuchale/main.main.en.compiled.js',
]);

let runtime = toRuntime(Object.values(ENGLISH)[0], 'en');

/** Load the texts of the page's language. */
export async function loadTexts(): Promise<void> {
  try {
    const texts = await OTHERS[`./.wuchale/main.main.${language}.compiled.js`]?.();
    if (texts !== undefined) runtime = toRuntime(texts, language);
    document.documentElement.lang = language;
  } catch {
    // They cannot be loaded: the page is in English.
  }
}

/** Return the texts. They stay the same until the page is loaded again, so nothing is reactive. */
export function getRuntime(): Runtime {
  return runtime;
}
export const getRuntimeRx = getRuntime;
