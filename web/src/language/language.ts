// The language of the page: the one that the person has chosen, else the first one of the browser that we have.

/** The languages of the page. The first one is that of the sources. */
export const LANGUAGES = ['en', 'de'] as const;
export type Language = (typeof LANGUAGES)[number];

const KEY = 'waypost:language';
const [SOURCE] = LANGUAGES;

/** Return the language that this browser remembers; null if the person has chosen none. */
export function rememberedLanguage(storage: Pick<Storage, 'getItem'>): Language | null {
  try {
    const stored = storage.getItem(KEY);
    return LANGUAGES.find((language) => language === stored) ?? null;
  } catch {
    return null; // the storage is off
  }
}

/** Remember a language; null forgets it, so that the browser chooses again. */
export function rememberLanguage(
  storage: Pick<Storage, 'setItem' | 'removeItem'>,
  language: Language | null,
): void {
  try {
    if (language === null) storage.removeItem(KEY);
    else storage.setItem(KEY, language);
  } catch {
    // The storage is full or off: the browser chooses the language.
  }
}

/** Return the first of the browser's languages that the page has, without its region; English if it has none of them. */
export function languageOf(preferred: readonly string[]): Language {
  const known = preferred.map((tag) => LANGUAGES.find((language) => language === baseOf(tag)));
  return known.find((language) => language !== undefined) ?? SOURCE;
}

/** Return how numbers and dates are written: as in the region that the browser names for the language, such as `de-AT`. */
export function localeOf(language: Language, preferred: readonly string[]): string {
  return preferred.find((tag) => baseOf(tag) === language) ?? (language === 'en' ? 'en-GB' : language);
}

function baseOf(tag: string): string {
  return tag.toLowerCase().split('-')[0] ?? '';
}

const isPage = typeof window !== 'undefined'; // else a unit test
const preferred = isPage ? navigator.languages : [];

/** The language of the page until it is loaded again. */
export const language: Language = (isPage ? rememberedLanguage(localStorage) : null) ?? languageOf(preferred);
/** The locale of its numbers and dates. */
export const locale = localeOf(language, preferred);

/**
 * Mark a text in a script or in an expression, so that it gets into the catalogue. The build replaces the text by a
 * reference to the catalogue. A text in the markup needs no mark.
 */
export function t(text: string): string {
  return text;
}
