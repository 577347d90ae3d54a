import { describe, expect, it } from 'vitest';
import type { Box } from '../../api/types';
import type { Label, Scene } from '../../player/scene';
import { buildTape, type Boxes } from '../../player/tape';
import { beginWay, extendWay, isDrawable, nextOf, placeAt, placesOf, type Point, type Way } from './actions';

// A corridor of ten cells, in which the learner walks from cell 2 to the right, turns back once, and goes on.
const CELLS = 10;
const cell = (number: number): Box => ({
  left: number / CELLS,
  top: 0,
  right: (number + 1) / CELLS,
  bottom: 1,
});
const middle = (number: number): Point => [(number + 0.5) / CELLS, 0.5];
const around = (state: number): Boxes => ({ left: cell(state - 1), right: cell(state + 1) });

function sceneOf(
  states: number[],
  actions: string[],
  boxes: (state: number) => Boxes = around,
  at = 0,
  labels: Label[] = [],
): Scene {
  const segment = {
    subgoal: 'end',
    states,
    actions,
    frames: [],
    landmarks: [],
    action_landmarks: states.map(boxes),
  };
  const names = { domain: 'hall', renderer: 'hall', subgoals: ['end'], actions: ['left', 'right', 'drop'] };
  return { instance: null, tape: buildTape([], [segment]), vocabulary: names, at, current: 0, labels };
}

const walk = sceneOf([2, 3, 2, 3, 4], ['right', 'left', 'right', 'right']);

function drawn(scene: Scene, points: Point[], from = 0): Way {
  return points.reduce((way, point) => extendWay(way, scene, point), beginWay(from));
}

describe('the places of actions', () => {
  it('say what the learner did there, and what the label is', () => {
    const scene = sceneOf([2, 3], ['right'], around, 0, [{ frame: 0, name: 'left' }]);
    expect(placesOf(scene, 0)).toEqual([
      { box: cell(1), marks: [{ action: 'left', isLearners: false, isChosen: true }] },
      { box: cell(3), marks: [{ action: 'right', isLearners: true, isChosen: false }] },
    ]);
    expect(
      placesOf(
        sceneOf([2, 3], ['right'], () => ({})),
        0,
      ),
    ).toEqual([]);
  });

  it('are chosen in turn where two actions have the same box', () => {
    const both = (): Boxes => ({ drop: cell(3), right: cell(3) });
    const next = (name: string | null): string => {
      const [place] = placesOf(sceneOf([2, 3], ['right'], both, 0, [{ frame: 0, name }]), 0);
      return place ? nextOf(place) : '';
    };
    expect([null, 'right', 'drop', 'left'].map(next)).toEqual(['right', 'drop', 'right', 'right']);
  });

  it.each<[Point, Point, string | null]>([
    [middle(3), [400, 40], 'right'],
    [[0.31, 0.01], [400, 40], 'right'], // in a corner
    [middle(2), [400, 40], null], // between the two
    [middle(8), [400, 40], null],
    [[0.26, 0.5], [100, 10], 'right'], // a small picture: beside both boxes, within 24 pixels
    [[0.24, 0.5], [100, 10], 'left'], // nearer to the other one
    [[0.35, 1.05], [100, 10], 'right'],
    [[0.55, 0.5], [100, 10], null],
  ])('are hit at %o of %o pixels: %s', (point, size, action) => {
    expect(placeAt(placesOf(walk, 0), point, size)?.marks[0]?.action ?? null).toBe(action);
  });
});

describe('a way through the boxes', () => {
  it('labels the states of the learner as long as the learner went the same way', () => {
    const way = drawn(walk, [middle(2), middle(3), middle(4), middle(5)]);
    expect(way.choices).toEqual([
      { frame: 0, name: 'right' },
      { frame: 1, name: 'right' }, // here the learner went back
    ]);
    expect(way.frame).toBeNull();
  });

  it('goes on at the next state where it follows the learner', () => {
    expect(drawn(walk, [middle(3), middle(4)], 2)).toMatchObject({
      choices: [
        { frame: 2, name: 'right' },
        { frame: 3, name: 'right' },
      ],
      frame: 4,
    });
    expect(drawn(walk, [middle(5)], 4).choices).toEqual([]); // the last state needs no action
  });

  it('passes a box at its edge without entering it', () => {
    expect(drawn(walk, [[0.31, 0.5]]).choices).toEqual([]);
    expect(drawn(walk, [[0.35, 0.1]]).choices).toEqual([]);
  });

  it('does an action that changes nothing once, until it enters the box again', () => {
    const wall = sceneOf([2, 2, 2], ['right', 'right']);
    expect(drawn(wall, [middle(3), middle(3)]).choices).toHaveLength(1);
    expect(drawn(wall, [middle(3), middle(2), middle(3)]).choices).toHaveLength(2);
  });

  it('enters the same box with another action, such as a step after a turn', () => {
    const boxes = (state: number): Boxes => (state === 0 ? { left: cell(1) } : { right: cell(1) });
    const turn = sceneOf([0, 1, 5], ['left', 'right'], boxes);
    expect(drawn(turn, [middle(1), middle(1), middle(1)]).choices.map(({ name }) => name)).toEqual([
      'left',
      'right',
    ]);
  });

  it('is drawn only where boxes are not the same in all pictures', () => {
    expect(isDrawable(walk.tape)).toBe(true);
    expect(isDrawable(sceneOf([2, 3], ['right'], () => around(5)).tape)).toBe(false);
    expect(isDrawable(sceneOf([2, 3], ['right'], () => ({})).tape)).toBe(false);
  });
});
