// Sets the theme before the first paint, so that the other theme does not flash. It must match src/ui/style/theme.svelte.ts.
try {
  const theme = localStorage.getItem('waypost:theme');
  if (theme === 'light' || theme === 'dark') document.documentElement.dataset.theme = theme;
} catch {
  // Storage may be off; then the system's own theme applies.
}
