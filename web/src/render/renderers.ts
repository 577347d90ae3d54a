// The renderers, by the name in the vocabulary of a run. A new renderer is added here.
import type { Component } from 'svelte';
import { t } from '../language/language';
import MazeView from './maze/MazeView.svelte';
import { stepMaze } from './maze/steps';
import PictureView from './PictureView.svelte';
import type { Pointing, Scene, Step } from '../player/scene';

/** Draws a scene. Without `pointing`, the picture is only looked at. */
type Renderer = Component<{ scene: Scene; pointing?: Pointing }>;

/** The renderers. Other domains are shown with the pictures that the learner sent, or as text. */
const RENDERERS: Readonly<Record<string, Renderer>> = { maze: MazeView };

export function rendererOf(name: string): Renderer {
  return Object.hasOwn(RENDERERS, name) ? (RENDERERS[name] ?? PictureView) : PictureView;
}

/** Domains whose steps the web app can compute. It can show their demonstrations without the learner. */
const STEPS: Readonly<Record<string, Step>> = { maze: stepMaze };

export function stepOf(name: string): Step | null {
  return Object.hasOwn(STEPS, name) ? (STEPS[name] ?? null) : null;
}

/** Return what the marks on a domain's pictures mean. */
export function legendOf(name: string): string {
  return rendererOf(name) === MazeView
    ? t(
        'On the map, the disc is the agent, the ring with a dot is the target, and an empty ring is the end. A number with a letter marks the state where a subgoal was chosen. Segments that the question is not about are faint. A bar with two posts is a door. Click the path to go there; where steps are labeled, this marks the first wrong step. Where subgoals are asked for, click a door or the target to choose one. Where labels are asked for, drag along the right way to label all states or segments on it. In a demonstration, click beside the agent or drag from it to move it.',
      )
    : t(
        'A box in the picture is the place of a subgoal; the thick one belongs to the segment. Where subgoals are asked for, click a box to choose its subgoal. A dashed box shows where an action leads. Where actions are asked for, click it, or drag along the right way. Under the picture are the states where a subgoal was chosen, and the steps of the current segment. Click one to go there; where steps are labeled, this marks the first wrong step. Segments that the question is not about are dashed.',
      );
}
