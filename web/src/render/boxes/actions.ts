// The landmarks of actions in a picture: where they lead, what is under the pointer, and what a drawn way means.
import type { Box } from '../../api/types';
import type { Choice, Scene } from '../../player/scene';
import { actionAt, askedFrames, type Tape } from '../../player/tape';

/** A box in the picture, and the actions that lead there. */
export interface Place {
  readonly box: Box;
  readonly marks: readonly Mark[];
}

/** An action at its place. */
interface Mark {
  readonly action: string;
  readonly isLearners: boolean; // whether the learner did this in the state shown
  readonly isChosen: boolean; // whether it is the label of the state shown
}

/** A point in a picture, or its size: to the right and down. */
export type Point = readonly [x: number, y: number];

/** WCAG 2.2 asks for targets of 24 CSS pixels. */
const LEAST_TARGET = 24;

/** Return the places of the actions in the picture of a frame, in the order of the vocabulary. */
export function placesOf({ tape, vocabulary, labels }: Scene, frame: number): Place[] {
  const boxes = tape.landmarks[frame]?.actions ?? {};
  const label = labels.find((one) => one.frame === frame)?.name;
  const learners = actionAt(tape, frame);
  const found = new Map<string, Place>();
  for (const action of vocabulary.actions) {
    const box = boxes[action];
    if (box === undefined) continue;
    const mark = { action, isLearners: action === learners, isChosen: action === label };
    found.set(keyOf(box), { box, marks: [...(found.get(keyOf(box))?.marks ?? []), mark] });
  }
  return [...found.values()];
}

/**
 * Return the place under a point of the picture; null if there is none. A small box can be hit beside it, so of several
 * places the one counts whose middle is nearest. `size` is the size of the picture in CSS pixels.
 */
export function placeAt(places: readonly Place[], point: Point, size: Point): Place | null {
  const distance = (place: Place): number => Math.hypot(...offsetOf(place.box, point, size));
  const [nearest] = places
    .filter(({ box }) => {
      const [right, down] = offsetOf(box, point, size);
      const [width, height] = [(box.right - box.left) * size[0], (box.bottom - box.top) * size[1]];
      return right <= Math.max(width, LEAST_TARGET) / 2 && down <= Math.max(height, LEAST_TARGET) / 2;
    })
    .toSorted((a, b) => distance(a) - distance(b));
  return nearest ?? null;
}

/** Return the action that a click at a place chooses: of several, the one after the one that is chosen. */
export function nextOf({ marks }: Place): string {
  const next = marks[marks.findIndex((mark) => mark.isChosen) + 1] ?? marks[0];
  return next?.action ?? '';
}

/** A way that is drawn through the boxes of actions. It begins in the state shown and follows the learner's states. */
export interface Way {
  readonly choices: readonly Choice[]; // the labels of the states that it passed
  readonly frame: number | null; // the state whose boxes it can enter next; null: it left the learner's way
  readonly inside: string | null; // the box and the action that it entered last, as long as it stays there
}

/** Return whether a way can be drawn: where an action leads is not the same in every picture. */
export function isDrawable({ landmarks }: Tape): boolean {
  const first: Record<string, string> = {};
  return landmarks.some(({ actions }) =>
    Object.entries(actions).some(([action, box]) => (first[action] ??= keyOf(box)) !== keyOf(box)),
  );
}

export function beginWay(frame: number): Way {
  return { choices: [], frame, inside: null };
}

/**
 * Return the way with its next point. In the middle of an action's box, it labels the state with this action. If the
 * learner did the same, it goes on from the learner's next state. Only asked states can be labeled.
 */
export function extendWay(way: Way, scene: Scene, point: Point): Way {
  const { frame } = way;
  const asked = askedFrames(scene.tape);
  if (frame === null || !asked.slice(0, -1).includes(frame)) return way;
  const place = placesOf(scene, frame).find(({ box }) => isInMiddle(box, point));
  const name = place?.marks[0]?.action;
  if (place === undefined || name === undefined) return { ...way, inside: null };
  const inside = `${keyOf(place.box)} ${name}`;
  if (inside === way.inside) return way; // an action that changes nothing is done once, however long the pointer stays
  const goesOn = name === actionAt(scene.tape, frame) && asked.includes(frame + 1);
  return { choices: [...way.choices, { frame, name }], frame: goesOn ? frame + 1 : null, inside };
}

/** Return how far a point is from the middle of a box, in pixels. */
function offsetOf(
  { left, top, right, bottom }: Box,
  [x, y]: Point,
  [width, height]: Point,
): [number, number] {
  return [Math.abs(x - (left + right) / 2) * width, Math.abs(y - (top + bottom) / 2) * height];
}

/** Return whether a point is in the middle half of a box. At the edge of a box, a way may only pass by. */
function isInMiddle(box: Box, point: Point): boolean {
  const [right, down] = offsetOf(box, point, [1, 1]);
  return right <= (box.right - box.left) / 4 && down <= (box.bottom - box.top) / 4;
}

function keyOf({ left, top, right, bottom }: Box): string {
  return [left, top, right, bottom].join();
}
