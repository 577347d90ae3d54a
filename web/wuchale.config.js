// The catalogue: which texts of the sources belong to it, and in which languages it is. docs/decisions/0033 explains it.
import { adapter as componentAdapter } from '@wuchale/svelte';
import { pofile } from 'wuchale';
import { adapter as scriptAdapter } from 'wuchale/adapter-vanilla';

/** The attributes of elements and components whose values are texts. */
const ATTRIBUTES = new Set([
  ...['alt', 'aria-label', 'aria-valuetext', 'placeholder', 'title'],
  ...['empty', 'how', 'label', 'legend', 'next', 'text', 'where', 'xName'],
]);

/** Return whether something written in a source is a text: in the markup, in such an attribute, or in `t(...)`. */
function isText({ msgStr, details }) {
  if (!msgStr.some((text) => /\p{L}/u.test(text))) return false;
  if (details.scope === 'markup') return !['code', 'pre'].includes(details.element);
  if (details.scope === 'attribute') return ATTRIBUTES.has(details.attribute);
  if (details.call !== 't') return false;
  // A module is evaluated before the catalogue is loaded, so it would keep the English text.
  if (details.file.endsWith('.ts') && details.funcName == null)
    throw new Error(`${details.file}: move the text “${msgStr}” into a function`);
  return true;
}

const options = {
  files: { include: ['src/**/*.svelte', 'src/**/*.ts'], ignore: ['**/*.d.ts', '**/*.test.ts'] },
  storage: pofile({ dir: 'src/language', separateUrls: false }),
  heuristic: (found) => isText(found) && 'message',
  patterns: [{ name: 'count', args: ['other', 'message', 'pluralFunc'] }],
  loader: 'custom', // main.loader.ts
};
// The language of a loaded page does not change, so nothing is reactive: a component asks for the texts once, as does a
// function of a module.
const components = componentAdapter({
  ...options,
  runtime: { useReactive: false, initReactive: ({ funcName }) => (funcName === undefined ? false : null) },
});
const scripts = scriptAdapter({
  ...options,
  runtime: { useReactive: false, initReactive: ({ nested }) => (nested ? null : false) },
});

export default {
  locales: ['en', 'de'],
  localesDir: 'src/language',
  adapters: {
    main: {
      ...components,
      transform: (source) => (source.filename.endsWith('.svelte') ? components : scripts).transform(source),
    },
  },
  ai: null, // no machine translates: by default, this tool asks one over the network
  logLevel: 'warn',
};
