import type { Component } from 'svelte';
import MazeView from '../maze/MazeView.svelte';
import PictureView from './PictureView.svelte';
import type { Scene } from './scene';

type Renderer = Component<{ scene: Scene }>;

/** By the name a run's vocabulary gives; of any other domain the pictures its learner sent are shown, else text. */
const RENDERERS: Readonly<Record<string, Renderer>> = { maze: MazeView };

export function rendererOf(name: string): Renderer {
  return Object.hasOwn(RENDERERS, name) ? (RENDERERS[name] ?? PictureView) : PictureView;
}
