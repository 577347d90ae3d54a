// An ESLint rule: a text in a script or in an expression is marked with `t(…)`, so that it gets into the catalogue.

/** Two words, or a word that begins a sentence. */
const TEXT = /\p{L}\p{P}*\s+\p{P}*[\p{L}\d]|\d\p{P}*\s+\p{L}|^[^\p{L}+]*\p{Lu}\p{Ll}+\p{P}?$/u;
/** The names of keys look like words. */
const KEY =
  /^(?:Arrow\w+|Alt|Backspace|Control|Dead|End|Enter|Escape|Home|Meta|Page\w+|Shift|Space|Tab|Unidentified)$/;
const MARKS = new Set(['t', 'count']);
/** Calls whose arguments are for the browser or for a comparison. */
const OTHER_CALLS = new Set([
  'closest',
  'matches',
  'matchMedia',
  'MediaQuery',
  'querySelector',
  'querySelectorAll',
]);
/** Types, names of modules, and what a program error says. */
const OTHER_NODES = new Set(['ImportDeclaration', 'ThrowStatement', 'TSLiteralType']);

/** Return whether a node stands in `t(…)`, or is no text for people. */
function isFine(node) {
  for (let at = node; at; at = at.parent) {
    if (OTHER_NODES.has(at.type)) return true;
    if (at.type === 'BinaryExpression' && at.operator.endsWith('==')) return true;
    if (at.type === 'CallExpression' || at.type === 'NewExpression') {
      const name = at.callee.name ?? at.callee.property?.name;
      if (MARKS.has(name) || OTHER_CALLS.has(name)) return true;
    }
    if (at.type === 'SvelteAttribute') return at.key.name === 'class';
    if (at.type.endsWith('Statement')) return false;
  }
  return false;
}

export default {
  meta: {
    type: 'problem',
    messages: { unmarked: 'Write t(…) around “{{text}}”, so that it gets into the catalogue.' },
    schema: [],
  },
  create(context) {
    function check(node, text) {
      if (TEXT.test(text) && !KEY.test(text) && !isFine(node))
        context.report({ node, messageId: 'unmarked', data: { text } });
    }
    return {
      Literal: (node) => typeof node.value === 'string' && check(node, node.value),
      TemplateLiteral: (node) => check(node, node.quasis.map(({ value }) => value.cooked).join('1')),
    };
  },
};
