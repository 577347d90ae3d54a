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
  readonly name: string | null; // of the action, or of the subgoal chosen here; null: the segment should have ended here
}

/** What pointing at the picture does. Every act has a key, too: this is the same with a mouse, a pen or a finger. */
export interface Pointing {
  /** Show a frame, and change no label. Null: only the last frame is shown. */
  readonly show: ((frame: number) => void) | null;
  /**
   * Pick the step that begins in a frame, and show it. In Label_HI, this selects its segment; where actions are
   * labeled, a step after the first unlabeled one is marked as the first wrong step. Null as above.
   */
  readonly pick: ((frame: number) => void) | null;
  /** Choose a subgoal for the current segment, or the next one of a demonstration. Null: none is asked for now. */
  readonly choose: ((subgoal: string) => void) | null;
  /**
   * Label the state shown with an action and go on to the next, or carry the action out in a demonstration. Null: no
   * action is asked for in this state.
   */
  readonly act: ((action: string) => void) | null;
  /** Actions of a demonstration whose states are not known yet: the agent is further than the picture shows it. */
  readonly pending: readonly string[];
  /** Null if the query asks for no labels. */
  readonly labeling: Labeling | null;
}

/** What labels the picture. */
export interface Labeling {
  readonly of: 'subgoals' | 'actions';
  /** Label the segments or states along a way. `end` is the frame of the state where the way ends, if there is one. */
  draw(choices: readonly Choice[], end: number | null): void;
}

/** A label that names something: every label but the end of a segment. */
export interface Choice extends Label {
  readonly name: string;
}

/** Returns the state that an action leads to. */
export type Step = (state: Json, action: string) => Json;
