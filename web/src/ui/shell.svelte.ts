import type { Me } from '../api/types';
import { PAGE_BINDINGS, type Binding, type Command } from '../keys/registry';

/** What the frame of the page shows for the view inside it. */
class Shell {
  bindings: readonly Binding[] = $state.raw(PAGE_BINDINGS);
  unsaved = $state(0);
  me: Me | null = $state.raw(null);
  helpOpen = $state(false);
  #run: ((command: Command) => void) | null = null;

  /** Have a view answer to these keys until the returned function is called. */
  use(bindings: readonly Binding[], run: (command: Command) => void): () => void {
    this.bindings = bindings;
    this.#run = run;
    return () => {
      if (this.#run !== run) return;
      this.bindings = PAGE_BINDINGS;
      this.#run = null;
    };
  }

  run(command: Command): void {
    if (command === 'help') this.helpOpen = true;
    else this.#run?.(command);
  }
}

export const shell = new Shell();
