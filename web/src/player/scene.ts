// The scene: everything that a renderer draws.
import type { Json, Vocabulary } from '../api/types';
import type { Tape } from './tape';

export interface Scene {
  readonly instance: Json;
  readonly tape: Tape;
  readonly vocabulary: Vocabulary;
  readonly at: number; // the frame shown
  readonly current: number | null; // the index of the highlighted stretch; null for none
  readonly labels: readonly Label[];
}

/** The annotator's label of a frame. */
export interface Label {
  readonly frame: number;
  readonly action: string | null; // null: the segment should have ended here
}

/** Returns the state that an action leads to. */
export type Step = (state: Json, action: string) => Json;
