// Keys that a person has chosen instead of the default keys.
import { ANSWERABLE, type Vocabulary } from '../api/types';
import { printed } from './keys';
import { bindingsFor, type Binding, type Mode } from './registry';

/** The chosen keys, by the id of their binding: see `idOf`. */
export type Keymap = Readonly<Record<string, string>>;

const MODES: readonly Mode[] = [...ANSWERABLE, 'waiting'];
const KEPT_KEYS = new Set(['Escape', 'Tab', 'Shift', 'Control', 'Alt', 'Meta', 'Dead', 'Unidentified']);

/** Return a binding's id, the same in every vocabulary: subgoals and actions are identified by name, not by number. */
export function idOf(binding: Binding): string {
  return binding.command.startsWith('choose:') ? `choose ${binding.label}` : binding.command;
}

/** Return the bindings with the chosen keys. Other bindings lose a chosen key. */
export function remapped(bindings: readonly Binding[], keymap: Keymap): readonly Binding[] {
  const chosen = bindings.map((binding) => keymap[idOf(binding)]);
  const taken = new Set(chosen);
  return bindings.map((binding, index) => {
    const key = chosen[index];
    if (key !== undefined) return { ...binding, keys: [key] };
    return binding.keys.some((one) => taken.has(one))
      ? { ...binding, keys: binding.keys.filter((one) => !taken.has(one)) }
      : binding;
  });
}

/** Return why a binding cannot have a key, or null if it can. The key must be free in every mode of the binding. */
export function refusal(
  binding: Binding,
  key: string,
  keymap: Keymap,
  vocabulary: Vocabulary | null,
): string | null {
  if (KEPT_KEYS.has(key)) return `${printed(key)} cannot be chosen. Press another key.`;
  const id = idOf(binding);
  const { [id]: _, ...others } = keymap;
  for (const mode of MODES) {
    const bindings = remapped(bindingsFor(mode, vocabulary), others);
    if (!bindings.some((one) => idOf(one) === id)) continue;
    const other = bindings.find((one) => idOf(one) !== id && one.keys.includes(key));
    if (other) return `${printed(key)} already means “${other.label}”. Press another key.`;
  }
  return null;
}

const KEY = 'waypost:keys';

/** Return the keymap that this browser has stored; an empty one if storage is off or contains something else. */
export function loadKeymap(storage: Pick<Storage, 'getItem'>): Keymap {
  try {
    const stored: unknown = JSON.parse(storage.getItem(KEY) ?? '{}');
    if (typeof stored !== 'object' || stored === null) return {};
    return Object.fromEntries(Object.entries(stored).filter(([, key]) => typeof key === 'string'));
  } catch {
    return {};
  }
}

export function saveKeymap(storage: Pick<Storage, 'setItem' | 'removeItem'>, keymap: Keymap): void {
  try {
    if (Object.keys(keymap).length === 0) storage.removeItem(KEY);
    else storage.setItem(KEY, JSON.stringify(keymap));
  } catch {
    // Storage may be off; then the keys last until the web app is reloaded.
  }
}
