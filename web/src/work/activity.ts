// Records whether the annotator is active. The server counts the active seconds.

const SIGNS = ['keydown', 'pointerdown', 'pointermove', 'wheel'] as const;

/** Listens to keys and pointer events. */
class Activity {
  #active = false;

  constructor() {
    for (const sign of SIGNS) {
      window.addEventListener(sign, () => (this.#active = true), { capture: true, passive: true });
    }
  }

  /** Return whether the annotator did anything since the last call. */
  take(): boolean {
    const active = this.#active;
    this.#active = false;
    return active;
  }
}

export const activity = new Activity();
