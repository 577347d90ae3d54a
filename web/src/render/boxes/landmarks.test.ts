import { describe, expect, it } from 'vitest';
import type { Box } from '../../api/types';
import type { Label, Scene } from '../../player/scene';
import { buildTape } from '../../player/tape';
import { fitted, landmarksOf, nextOf } from './landmarks';

const stair = { left: 0.8, top: 0.8, right: 0.85, bottom: 0.85 };
const door = { left: 0.8, top: 0.2, right: 0.9, bottom: 0.4 };
const boxes = { stair, stair_back: stair, door };

function sceneOf(landmarks: Record<string, Box>, labels: Label[] = [], current: number | null = 0): Scene {
  const segment = {
    subgoal: 'door',
    states: [1, 2],
    actions: ['up'],
    frames: [],
    landmarks: [landmarks],
    action_landmarks: [],
  };
  return {
    instance: null,
    tape: buildTape([], [segment]),
    vocabulary: {
      domain: 'room',
      renderer: 'room',
      subgoals: ['stair', 'key', 'stair_back', 'door'],
      actions: ['up'],
    },
    at: 1,
    current,
    labels,
  };
}

describe('the landmarks of a picture', () => {
  it('are its boxes with their subgoals, the smallest in front', () => {
    const found = landmarksOf(sceneOf(boxes));
    expect(found.map(({ box, marks }) => [box, marks.map((mark) => mark.subgoal)])).toEqual([
      [door, ['door']],
      [stair, ['stair', 'stair_back']],
    ]);
    expect(landmarksOf(sceneOf({}))).toEqual([]);
  });

  it('have the keys that choose their subgoals', () => {
    const tags = landmarksOf(sceneOf(boxes)).flatMap(({ marks }) => marks.map((mark) => mark.tag));
    expect(tags).toEqual(['4', '1', '3']);
  });

  it('tell which subgoal is asked about, and which is chosen', () => {
    const marks = landmarksOf(sceneOf(boxes, [{ frame: 0, name: 'stair' }])).flatMap((one) => one.marks);
    expect(marks.filter((mark) => mark.isAsked).map((mark) => mark.subgoal)).toEqual(['door']);
    expect(marks.filter((mark) => mark.isChosen).map((mark) => mark.subgoal)).toEqual(['stair']);
    const none = landmarksOf(sceneOf(boxes, [], null)).flatMap((one) => one.marks);
    expect(none.some((mark) => mark.isAsked || mark.isChosen)).toBe(false);
  });

  it('are chosen in turn where two subgoals have the same box', () => {
    const next = (chosen: string | null): string => {
      const labels = chosen === null ? [] : [{ frame: 0, name: chosen }];
      const [landmark] = landmarksOf(sceneOf({ stair, stair_back: stair }, labels));
      return landmark ? nextOf(landmark) : '';
    };
    expect([null, 'stair', 'stair_back', 'door'].map(next)).toEqual([
      'stair',
      'stair_back',
      'stair',
      'stair',
    ]);
  });
});

describe('a picture in its frame', () => {
  it.each([
    [
      { width: 320, height: 210 },
      { width: 640, height: 600 },
      { width: 640, height: 420 },
    ],
    [
      { width: 40, height: 80 },
      { width: 640, height: 600 },
      { width: 300, height: 600 },
    ],
  ])('keeps its shape: %o in %o', (picture, frame, size) => expect(fitted(picture, frame)).toEqual(size));
});
