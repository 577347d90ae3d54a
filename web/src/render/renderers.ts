import type { Component } from 'svelte';
import MazeView from '../maze/MazeView.svelte';
import { stepMaze } from '../maze/steps';
import PictureView from './PictureView.svelte';
import type { Scene, Step } from '../player/scene';

type Renderer = Component<{ scene: Scene }>;

/** By the name a run's vocabulary gives; of any other domain the pictures its learner sent are shown, else text. */
const RENDERERS: Readonly<Record<string, Renderer>> = { maze: MazeView };

export function rendererOf(name: string): Renderer {
  return Object.hasOwn(RENDERERS, name) ? (RENDERERS[name] ?? PictureView) : PictureView;
}

/** Domains whose every step the page knows without the learner: what a demonstration's actions came to. */
const STEPS: Readonly<Record<string, Step>> = { maze: stepMaze };

export function stepOf(name: string): Step | null {
  return Object.hasOwn(STEPS, name) ? (STEPS[name] ?? null) : null;
}
