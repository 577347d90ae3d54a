import type { Json, Vocabulary } from '../api/types';
import type { Tape } from './tape';

/** What a renderer is given to draw. */
export interface Scene {
  readonly instance: Json;
  readonly tape: Tape;
  readonly vocabulary: Vocabulary;
  readonly at: number; // the frame shown
  readonly current: number | null; // the stretch in question, if one of several is
  readonly labels: readonly Label[];
}

/** What the annotator said about a frame. */
export interface Label {
  readonly frame: number;
  readonly action: string | null; // null: the segment should have ended here
}

/** The state an action leads to. */
export type Step = (state: Json, action: string) => Json;
