import { describe, expect, it } from 'vitest';
import type { Query } from '../../api/types';
import { stepMaze } from '../../render/maze/steps';
import { buildTape } from '../../player/tape';
import { labelsOf, tapeOf } from './replay.svelte';

describe('the replay of a query', () => {
  const segment = {
    subgoal: 'north',
    states: [0, 1, 2, 3],
    actions: ['up', 'up', 'left'],
    frames: [],
    landmarks: [],
    action_landmarks: [],
  };

  it('shows where the segment should have ended, and no label after that', () => {
    const labels = labelsOf(
      { kind: 'label_lo', actions: ['up', 'down', null], terminations: [false, false, true, false] },
      buildTape([], [segment]),
    );
    expect(labels).toEqual([
      { frame: 0, name: 'up' },
      { frame: 1, name: 'down' },
      { frame: 2, name: null },
    ]);
  });

  it('shows a demonstration where the page can compute steps, and only its start elsewhere', () => {
    const ask = { kind: 'hier_demo', context: [], state: [5, 2] } as unknown as Query['ask'];
    const segments = [
      { subgoal: 'north', actions: ['up', 'up'] },
      { subgoal: 'east', actions: ['right'] },
    ];
    const query = { ask, answer: { kind: 'hier_demo' as const, segments, replay: null } };
    expect(tapeOf(query, stepMaze).frames).toEqual([
      [5, 2],
      [4, 2],
      [3, 2],
      [3, 3],
    ]);
    expect(tapeOf(query, null).frames).toEqual([[5, 2]]);
    const unanswered = tapeOf({ ask, answer: null }, stepMaze);
    expect([unanswered.frames, unanswered.goesOn]).toEqual([[[5, 2]], true]);
  });

  it('shows a demonstration after what the learner did, which failed in its last segment', () => {
    const context = [
      {
        subgoal: 'west',
        states: [
          [5, 3],
          [5, 2],
        ],
        actions: ['left'],
        frames: [],
        landmarks: [],
        action_landmarks: [],
      },
    ];
    const ask = { kind: 'hier_demo', context, state: [5, 2] } as unknown as Query['ask'];
    const segments = [{ subgoal: 'north', actions: ['up'] }];
    const tape = tapeOf({ ask, answer: { kind: 'hier_demo' as const, segments, replay: null } }, stepMaze);
    expect([tape.frames, tape.start]).toEqual([
      [
        [5, 3],
        [5, 2],
        [4, 2],
      ],
      1,
    ]);
    expect(tape.stretches.map(({ asked, failed }) => [asked, failed])).toEqual([
      [false, true],
      [true, undefined],
    ]);
  });

  it('shows a demonstration of any other domain as the annotator saw it', () => {
    const ask = { kind: 'hier_demo', context: [], state: 's1' } as unknown as Query['ask'];
    const segments = [
      { subgoal: 'north', actions: ['up', 'up'] },
      { subgoal: 'east', actions: ['right'] },
    ];
    const replay = {
      states: ['s1', 's2', 's3', 's4'],
      frames: ['a', 'b', 'c', 'd'],
      landmarks: [],
      action_landmarks: [],
    };
    const tape = tapeOf({ ask, answer: { kind: 'hier_demo', segments, replay } }, null);
    expect([tape.frames, tape.pictures, tape.goesOn]).toEqual([replay.states, replay.frames, false]);
    expect(tape.stretches.map(({ first, last, subgoal }) => [first, last, subgoal])).toEqual([
      [0, 2, 'north'],
      [2, 3, 'east'],
    ]);
    const bare = { ...replay, frames: [], landmarks: [], action_landmarks: [] };
    expect(tapeOf({ ask, answer: { kind: 'hier_demo', segments, replay: bare } }, null).pictures).toEqual([
      null,
      null,
      null,
      null,
    ]);
  });
});
