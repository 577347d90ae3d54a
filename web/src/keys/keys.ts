// Key presses: how keys are named and printed, and which binding a press means.
import { t } from '../language/language';
import type { Binding, Command } from './registry';

/** The part of a KeyboardEvent that identifies the key. */
export type KeyPress = Pick<
  KeyboardEvent,
  'key' | 'code' | 'shiftKey' | 'ctrlKey' | 'altKey' | 'metaKey' | 'repeat' | 'isComposing'
>;

/** Return the name of a key: `p`, `?`, `Enter`, `Shift+Enter`, `Shift+s`, `Ctrl+z` (on a Mac, with the command key). */
export function keyOf(press: KeyPress): string {
  const typed = isForeign(press.key) ? placeOf(press.code) : undefined;
  const key = typed ?? (press.key.length === 1 ? press.key.toLowerCase() : press.key);
  const shifts = press.shiftKey && (key.length > 1 || /[a-z ]/.test(key));
  const name = shifts ? `Shift+${key}` : key;
  return press.ctrlKey || press.metaKey ? `Ctrl+${name}` : name;
}

/**
 * Return whether a key types a letter, mark or digit of a script other than Latin. Only such a key is named by its
 * place: on AZERTY or Dvorak, the key that types P is the one that is printed P.
 */
function isForeign(key: string): boolean {
  return /^[\p{L}\p{M}\p{Nd}]+$/u.test(key) && !/[\p{Script=Latin}0-9]/u.test(key);
}

/** What the keys that are not letters or digits type on a US keyboard. */
const SIGNS: Readonly<Record<string, string>> = {
  BracketLeft: '[',
  BracketRight: ']',
  Comma: ',',
  Period: '.',
  Minus: '-',
  Equal: '=',
};

/** Return what the key at a place types on a US keyboard; undefined if no binding could have it. */
function placeOf(code: string): string | undefined {
  return /^(?:Key|Digit)(.)$/.exec(code)?.[1]?.toLowerCase() ?? SIGNS[code];
}

const PRINTED: Readonly<Record<string, string>> = {
  ArrowLeft: '←',
  ArrowRight: '→',
  ArrowUp: '↑',
  ArrowDown: '↓',
  Backspace: '⌫',
  Enter: '↵',
};

/** Return how a key is printed on a button. */
export function printed(key: string): string {
  if (key.startsWith('Ctrl+')) return t(`Ctrl ${printed(key.slice(5))}`);
  if (key.startsWith('Shift+')) return `⇧ ${printed(key.slice(6))}`;
  if (key === ' ') return t('Space');
  if (key === 'Escape') return t('Esc');
  return PRINTED[key] ?? (key.length === 1 ? key.toUpperCase() : key);
}

/** Return a key as `aria-keyshortcuts` names it: P, Shift+Enter, Control+Z, Space. */
export function spoken(key: string): string {
  if (key.startsWith('Ctrl+')) return `Control+${spoken(key.slice(5))}`;
  if (key.startsWith('Shift+')) return `Shift+${spoken(key.slice(6))}`;
  if (key === ' ') return 'Space';
  return key.length === 1 ? key.toUpperCase() : key;
}

export function bindingOf(bindings: readonly Binding[], command: Command): Binding | undefined {
  return bindings.find((binding) => binding.command === command);
}

/** Return whether the focused element uses the key: a field uses every key, a slider the arrows, a button Enter and Space. */
export function belongsToElement(target: Element | null, key: string): boolean {
  if (target === null) return false;
  const field = target.closest<HTMLElement>('input, textarea, select, [contenteditable]');
  if (field instanceof HTMLInputElement && field.type === 'range') return SLIDER_KEYS.has(key);
  if (field !== null) return true;
  const pressable = target.closest('button, a[href], summary');
  return (
    pressable !== null && (key === 'Enter' || key === ' ') && pressable.closest('[data-hotkeys]') === null
  );
}

const SLIDER_KEYS = new Set([
  'ArrowLeft',
  'ArrowRight',
  'ArrowUp',
  'ArrowDown',
  'Home',
  'End',
  'PageUp',
  'PageDown',
]);

/** Return the binding of a key press, or null if it has none here. */
export function match(press: KeyPress, target: Element | null, bindings: readonly Binding[]): Binding | null {
  if (press.altKey || press.isComposing) return null;
  const key = keyOf(press);
  if (belongsToElement(target, key)) return null;
  return bindings.find((binding) => binding.keys.includes(key)) ?? null;
}

/** Run the commands of key presses until the returned function is called. While a dialog is open, run none. */
export function listen(bindings: () => readonly Binding[], run: (command: Command) => void): () => void {
  function onKeydown(event: KeyboardEvent): void {
    if (event.defaultPrevented || document.querySelector('dialog[open]') !== null) return;
    const target = event.target instanceof Element ? event.target : null;
    const binding = match(event, target, bindings());
    if (binding === null) return;
    event.preventDefault();
    if (!(event.repeat && binding.once)) run(binding.command);
  }
  window.addEventListener('keydown', onKeydown);
  return () => window.removeEventListener('keydown', onKeydown);
}
