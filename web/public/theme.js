// Before the first paint, so that a remembered theme never flashes the other one. Mirrors src/style/theme.svelte.ts.
try {
  const theme = localStorage.getItem('waypost:theme');
  if (theme === 'light' || theme === 'dark') document.documentElement.dataset.theme = theme;
} catch {
  // Storage may be off; then the system's own theme applies.
}
