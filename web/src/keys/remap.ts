// Keys that a person has chosen instead of the default keys.
import type { Vocabulary } from '../api/types';
import { t } from '../language/language';
import { printed } from './keys';
import { bindingsFor, MODES, type Binding } from './registry';

/** The chosen keys, by the id of their binding: see `idOf`. */
export type Keymap = Readonly<Record<string, string>>;

const KEPT_KEYS = new Set(['Escape', 'Tab', 'Shift', 'Control', 'Alt', 'Meta', 'Dead', 'Unidentified']);

/** Return a binding's id, the same in every vocabulary: subgoals and actions are identified by name, not by number. */
export function idOf({ command, label }: Binding): string {
  const [verb, number] = command.split(':');
  return number === undefined ? command : `${verb} ${label}`;
}

/** Return the bindings with the chosen keys. Other bindings lose a chosen key. */
export function remapped(bindings: readonly Binding[], keymap: Keymap): readonly Binding[] {
  const owners = new Map<string, Binding>(); // of the chosen keys
  for (const binding of bindings) {
    const key = keymap[idOf(binding)];
    // Two names may have got the same key in two domains. Where both names are, the first has the key.
    if (key !== undefined && !owners.has(key)) owners.set(key, binding);
  }
  return bindings.map((binding) => {
    const key = keymap[idOf(binding)];
    if (key !== undefined && owners.get(key) === binding) return { ...binding, keys: [key] };
    return binding.keys.some((one) => owners.has(one))
      ? { ...binding, keys: binding.keys.filter((one) => !owners.has(one)) }
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
  if (KEPT_KEYS.has(key)) return t(`${printed(key)} cannot be chosen. Press another key.`);
  const id = idOf(binding);
  const { [id]: _, ...others } = keymap;
  for (const mode of MODES) {
    const bindings = remapped(bindingsFor(mode, vocabulary), others);
    if (!bindings.some((one) => idOf(one) === id)) continue;
    const other = bindings.find((one) => idOf(one) !== id && one.keys.includes(key));
    if (other) return t(`${printed(key)} already means “${other.label}”. Press another key.`);
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
