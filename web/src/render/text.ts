// States and instances as text, for people to read.

/** Return a value as text: a string as it is, else indented JSON; null if there is nothing in it. */
export function textOf(value: unknown): string | null {
  if (typeof value === 'string') return value === '' ? null : value;
  const isEmpty = value === null || (typeof value === 'object' && Object.keys(value).length === 0);
  return isEmpty ? null : indented(value, '');
}

/** Return a value as JSON. A list or an object of plain values has one line, if it is short. */
function indented(value: unknown, margin: string): string {
  if (typeof value !== 'object' || value === null) return JSON.stringify(value);
  const isList = Array.isArray(value);
  const [open, close] = isList ? ['[', ']'] : ['{', '}'];
  const inner = `${margin}  `;
  const parts = Object.entries(value).map(
    ([name, part]) => (isList ? '' : `${JSON.stringify(name)}: `) + indented(part, inner),
  );
  const line = `${open}${parts.join(', ')}${close}`;
  const isPlain = Object.values(value).every((part) => typeof part !== 'object' || part === null);
  if (isPlain && line.length <= SHORT) return line;
  return `${open}\n${parts.map((part) => inner + part).join(',\n')}\n${margin}${close}`;
}

const SHORT = 60; // characters
