// The theme: light, dark, or the system's.
export type Theme = 'system' | 'light' | 'dark';
export const THEMES: readonly Theme[] = ['system', 'light', 'dark'];

const KEY = 'waypost:theme';

/** The chosen theme. The browser keeps it, and public/theme.js applies it before the first paint. */
class ThemeSwitch {
  choice: Theme = $state(remembered());
  systemIsDark = $state(false);

  constructor() {
    const query = window.matchMedia('(prefers-color-scheme: dark)');
    this.systemIsDark = query.matches;
    query.addEventListener('change', () => (this.systemIsDark = query.matches));
  }

  get isDark(): boolean {
    return this.choice === 'system' ? this.systemIsDark : this.choice === 'dark';
  }

  choose(theme: Theme): void {
    this.choice = theme;
    if (theme === 'system') delete document.documentElement.dataset.theme;
    else document.documentElement.dataset.theme = theme;
    try {
      if (theme === 'system') localStorage.removeItem(KEY);
      else localStorage.setItem(KEY, theme);
    } catch {
      // Storage may be off; then the choice lasts until the web app is reloaded.
    }
  }
}

function remembered(): Theme {
  const theme = document.documentElement.dataset.theme;
  return theme === 'light' || theme === 'dark' ? theme : 'system';
}

export const theme = new ThemeSwitch();
