// The state that all views share: who is signed in, which keys work, how many answers are unsaved.
import { api, unwrap } from '../api/client';
import type { Me, Vocabulary } from '../api/types';
import { commonBindings, type Binding, type Command } from '../keys/registry';
import { loadKeymap, remapped, saveKeymap, type Keymap } from '../keys/remap';

class Shell {
  keymap: Keymap = $state.raw(loadKeymap(localStorage));
  #given: readonly Binding[] | null = $state.raw(null); // null: those of every view
  readonly bindings: readonly Binding[] = $derived(remapped(this.#given ?? commonBindings(), this.keymap));
  unsaved = $state(0);
  unsavedAreKept = $state(true); // in the tab's storage; if not, they are lost when the tab closes
  me: Me | null = $state.raw(null);
  vocabulary: Vocabulary | null = $state.raw(null); // of the query on the screen
  helpOpen = $state(false);
  findOpen = $state(false);
  #run: ((command: Command) => void) | null = null;

  /** Load the signed-in user, unless it is known. */
  async loadMe(): Promise<void> {
    if (this.me !== null) return;
    try {
      this.me = await unwrap(api.GET('/api/v1/me'));
    } catch {
      // The view itself says that nobody is signed in.
    }
  }

  /** Use a view's keys, and run their commands, until the returned function is called. */
  use(bindings: readonly Binding[], run: (command: Command) => void): () => void {
    this.#given = bindings;
    this.#run = run;
    return () => {
      if (this.#run !== run) return;
      this.#given = null;
      this.#run = null;
    };
  }

  /** Give a binding another key; null restores its default keys. `id` is as `idOf` returns it. */
  remap(id: string, key: string | null): void {
    const { [id]: _, ...others } = this.keymap;
    this.setKeymap(key === null ? others : { ...others, [id]: key });
  }

  setKeymap(keymap: Keymap): void {
    this.keymap = keymap;
    saveKeymap(localStorage, keymap);
  }

  run(command: Command): void {
    if (command === 'help') this.helpOpen = true;
    else if (command === 'find') this.findOpen = true;
    else this.#run?.(command);
  }
}

export const shell = new Shell();

/**
 * Return whether a user reads prices, budgets and the paper's names of the queries. They are for the people who run the
 * learner and pay for it; annotators read plain words and their own session.
 */
export function readsPrices(me: Me | null): boolean {
  return me !== null && me.role !== 'annotator';
}

/** Return whether a user may see single queries. Annotators may not: they could tell gold queries from others. */
export function maySeeQueries(me: Me | null): boolean {
  return me !== null && me.role !== 'annotator';
}
