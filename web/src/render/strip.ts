// The film strip: which frames it shows, so that one can click them.
import type { Scene } from '../player/scene';
import { lastFrame, type Stretch } from '../player/tape';

/** A frame on the strip. */
export interface Still {
  readonly frame: number;
  readonly stretch: Stretch;
  readonly isStart: boolean; // whether the stretch's subgoal was chosen here
}

const AROUND = 20; // frames on each side of the one shown: more than a screen is wide

/**
 * Return the frames on the strip: where each subgoal was chosen, and of the current stretch those near the frame shown.
 * If only the last frame can be shown (`pick` is null), the strip has no others than the starts.
 */
export function stillsOf(scene: Scene, isOpen: boolean): Still[] {
  const last = lastFrame(scene.tape);
  return scene.tape.stretches.flatMap((stretch) => {
    const start = { frame: stretch.first, stretch, isStart: true };
    if (!isOpen || stretch.index !== scene.current) return stretch.last > stretch.first ? [start] : [];
    const from = Math.max(stretch.first + 1, scene.at - AROUND);
    const to = Math.min(stretch.last === last ? last : stretch.last - 1, scene.at + AROUND);
    const others = Array.from({ length: Math.max(0, to - from + 1) }, (_, place) => from + place);
    return [start, ...others.map((frame) => ({ frame, stretch, isStart: false }))];
  });
}
