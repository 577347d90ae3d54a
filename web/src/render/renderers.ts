import type { Component } from 'svelte';
import MazeView from '../maze/MazeView.svelte';
import PlainView from './PlainView.svelte';
import type { Scene } from './scene';

type Renderer = Component<{ scene: Scene }>;

/** By the name a run's vocabulary gives; a domain the page cannot draw is shown as text. */
const RENDERERS: Readonly<Record<string, Renderer>> = { maze: MazeView };

export function rendererOf(name: string): Renderer {
  return Object.hasOwn(RENDERERS, name) ? (RENDERERS[name] ?? PlainView) : PlainView;
}
