import type { Component } from 'svelte';
import MazeView from '../maze/MazeView.svelte';
import { stepMaze } from '../maze/steps';
import PlainView from './PlainView.svelte';
import type { Scene, Step } from './scene';

type Renderer = Component<{ scene: Scene }>;

/** By the name a run's vocabulary gives; a domain the page cannot draw is shown as text. */
const RENDERERS: Readonly<Record<string, Renderer>> = { maze: MazeView };

export function rendererOf(name: string): Renderer {
  return Object.hasOwn(RENDERERS, name) ? (RENDERERS[name] ?? PlainView) : PlainView;
}

/** Domains whose every step the page knows without the learner: what a demonstration's actions came to. */
const STEPS: Readonly<Record<string, Step>> = { maze: stepMaze };

export function stepOf(name: string): Step | null {
  return Object.hasOwn(STEPS, name) ? (STEPS[name] ?? null) : null;
}
