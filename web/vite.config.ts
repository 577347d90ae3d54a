// Builds the web app, serves it during development, and runs its unit tests.
import { svelte } from '@sveltejs/vite-plugin-svelte';
import { wuchale } from 'wuchale/vite';
import { defineConfig } from 'vitest/config';

export default defineConfig(({ mode }) => ({
  // Unit tests read the English texts of the sources.
  plugins: [...(mode === 'test' ? [] : [wuchale()]), svelte()],
  // A test that puts a component on the page needs the Svelte of browsers.
  ...(mode === 'test' ? { resolve: { conditions: ['browser'] } } : {}),
  build: {
    target: 'es2023',
    // The server's content security policy allows neither inline code nor data: URLs.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    cssCodeSplit: true,
    manifest: 'chunks.json', // from which the server knows what files a view needs
    // One file of scripts and one of styles for the work view, and one of each for what other views share: fewer
    // requests before a view can be drawn.
    rolldownOptions: {
      output: {
        codeSplitting: {
          groups: [
            { name: 'app', tags: ['$initial'] },
            { name: 'shared', minShareCount: 2 },
          ],
        },
      },
    },
  },
  server: {
    proxy: { '/api': { target: 'http://127.0.0.1:8000', ws: true } },
  },
  test: { include: ['src/**/*.test.ts'] }, // a test that needs a document says so in its first line
}));
