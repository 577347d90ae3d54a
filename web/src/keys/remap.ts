import { ANSWERABLE, type Vocabulary } from '../api/types';
import { printed } from './keys';
import { bindingsFor, type Binding, type Mode } from './registry';

/** Keys that a person has chosen, by what they do: see `idOf`. Pure. */
export type Keymap = Readonly<Record<string, string>>;

const MODES: readonly Mode[] = [...ANSWERABLE, 'waiting'];
const KEPT_KEYS = new Set(['Escape', 'Tab', 'Shift', 'Control', 'Alt', 'Meta', 'Dead', 'Unidentified']);

/** What a binding does, whatever the vocabulary: a subgoal or an action is known by its name, not by its number. */
export function idOf(binding: Binding): string {
  return binding.command.startsWith('choose:') ? `choose ${binding.label}` : binding.command;
}

/** The bindings with the chosen keys; a chosen key is taken from whatever had it. */
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

/** Why a key cannot be given to a binding, or null if it can: it must be free wherever the binding works. */
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

/** The keymap this browser keeps; none where storage is off or holds something else. */
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
    // Storage may be off; the keys then last as long as the page.
  }
}
