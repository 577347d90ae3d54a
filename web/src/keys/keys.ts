import type { Binding, Command } from './registry';

/** The part of a KeyboardEvent that decides which key was meant. */
export type KeyPress = Pick<
  KeyboardEvent,
  'key' | 'shiftKey' | 'ctrlKey' | 'altKey' | 'metaKey' | 'repeat' | 'isComposing'
>;

/** One name per key: `p`, `?`, `Enter`, `Shift+Enter`, `Shift+s`. */
export function keyOf(press: KeyPress): string {
  const key = press.key.length === 1 ? press.key.toLowerCase() : press.key;
  const shifts = press.shiftKey && (key.length > 1 || /[a-z ]/.test(key));
  return shifts ? `Shift+${key}` : key;
}

const PRINTED: Readonly<Record<string, string>> = {
  ArrowLeft: '←',
  ArrowRight: '→',
  ArrowUp: '↑',
  ArrowDown: '↓',
  ' ': 'Space',
  Backspace: '⌫',
  Enter: '↵',
};

/** How a key is printed on a button. */
export function printed(key: string): string {
  const [name = key, shift] = key.startsWith('Shift+') ? [key.slice(6), true] : [key];
  const face = PRINTED[name] ?? (name.length === 1 ? name.toUpperCase() : name);
  return shift ? `⇧ ${face}` : face;
}

export function bindingOf(bindings: readonly Binding[], command: Command): Binding | undefined {
  return bindings.find((binding) => binding.command === command);
}

/** Some keys belong to the element that has the focus: text to a field, arrows to a slider, Enter to a button. */
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

/** What a key press means among these bindings, or null where it means nothing here. */
export function match(press: KeyPress, target: Element | null, bindings: readonly Binding[]): Binding | null {
  if (press.ctrlKey || press.altKey || press.metaKey || press.isComposing) return null;
  const key = keyOf(press);
  if (belongsToElement(target, key)) return null;
  return bindings.find((binding) => binding.keys.includes(key)) ?? null;
}

/** Listen until the returned function is called. Nothing is heard while a dialog is open. */
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
