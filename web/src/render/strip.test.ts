import { describe, expect, it } from 'vitest';
import type { Scene } from '../player/scene';
import { buildTape } from '../player/tape';
import { stillsOf } from './strip';

function sceneOf(at: number, current: number | null, ...lengths: number[]): Scene {
  let state = 0;
  const segments = lengths.map((length) => {
    const states = Array.from({ length: length + 1 }, (_, step) => state + step);
    state += length;
    return {
      subgoal: 'go',
      states,
      actions: states.slice(1).map(() => 'up'),
      frames: [],
      landmarks: [],
      action_landmarks: [],
    };
  });
  const vocabulary = { domain: 'line', renderer: 'line', subgoals: ['go'], actions: ['up'] };
  return { instance: null, tape: buildTape([], segments), vocabulary, at, current, labels: [] };
}
const frames = (scene: Scene, isOpen = true): number[] => stillsOf(scene, isOpen).map(({ frame }) => frame);

describe('the film strip', () => {
  it('has the first frame of each segment, and each frame of the current one', () => {
    expect(frames(sceneOf(4, 1, 3, 3, 2))).toEqual([0, 3, 4, 5, 6]);
    expect(frames(sceneOf(0, 0, 3, 3))).toEqual([0, 1, 2, 3]);
    expect(stillsOf(sceneOf(4, 1, 3, 3), true).map(({ isStart }) => isStart)).toEqual([
      true,
      true,
      false,
      false,
      false,
    ]);
  });

  it('shows the last frame of a segment once, but that of the trajectory too', () => {
    expect(frames(sceneOf(3, 1, 3, 2))).toEqual([0, 3, 4, 5]);
  });

  it('shows the part of a long segment that is near the frame shown', () => {
    expect(frames(sceneOf(100, 1, 2, 200))).toEqual([
      0,
      2,
      ...Array.from({ length: 41 }, (_, place) => 80 + place),
    ]);
  });

  it('shows only the first frames where no other can be shown', () => {
    expect(frames(sceneOf(6, 1, 3, 3), false)).toEqual([0, 3]);
    expect(frames(sceneOf(6, null, 3, 3))).toEqual([0, 3]);
  });
});
