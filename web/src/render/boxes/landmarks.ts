// The landmarks of subgoals in a picture: where they are, and what choosing one would mean now.
import type { Box } from '../../api/types';
import { tagOf } from '../../keys/tags';
import type { Scene } from '../../player/scene';

/** A box in the picture, and the subgoals that have it. */
export interface Landmark {
  readonly box: Box;
  readonly marks: readonly Mark[];
}

/** A subgoal at its landmark. */
interface Mark {
  readonly subgoal: string;
  readonly tag: string; // what is written beside the box: the key that chooses the subgoal
  readonly isAsked: boolean; // whether the current segment is about this subgoal
  readonly isChosen: boolean; // whether it is the label of the current segment
}

/** Return the landmarks of the frame shown. The smallest is last, so that no other covers it. */
export function landmarksOf(scene: Scene): Landmark[] {
  const { subgoals } = scene.vocabulary;
  const current = scene.tape.stretches[scene.current ?? -1];
  const chosen = scene.labels.find((label) => label.frame === current?.first)?.name;
  const found = new Map<string, Landmark>();
  for (const [subgoal, box] of Object.entries(scene.tape.landmarks[scene.at]?.subgoals ?? {})) {
    const place = [box.left, box.top, box.right, box.bottom].join();
    const mark: Mark = {
      subgoal,
      tag: tagOf(subgoal, subgoals),
      isAsked: subgoal === current?.subgoal,
      isChosen: subgoal === chosen,
    };
    found.set(place, { box, marks: [...(found.get(place)?.marks ?? []), mark] });
  }
  return [...found.values()].sort((a, b) => area(b.box) - area(a.box));
}

/** Return the subgoal that a click in a box chooses: of several, the one after the one that is chosen. */
export function nextOf({ marks }: Landmark): string {
  const next = marks[marks.findIndex((mark) => mark.isChosen) + 1] ?? marks[0];
  return next?.subgoal ?? '';
}

/** Return where a picture is drawn that fills its frame as far as its shape allows, in pixels of the frame. */
export function fitted(picture: Size, frame: Size): Size {
  const scale = Math.min(frame.width / picture.width, frame.height / picture.height);
  return { width: picture.width * scale, height: picture.height * scale };
}

interface Size {
  readonly width: number;
  readonly height: number;
}

function area({ left, top, right, bottom }: Box): number {
  return (right - left) * (bottom - top);
}
