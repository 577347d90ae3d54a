export type Theme = 'system' | 'light' | 'dark';
export const THEMES: readonly Theme[] = ['system', 'light', 'dark'];

const KEY = 'waypost:theme';

/** Light, dark, or as the system has it; remembered, and applied before the first paint by public/theme.js. */
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
      // Storage may be off; the choice then lasts as long as the page.
    }
  }
}

function remembered(): Theme {
  const theme = document.documentElement.dataset.theme;
  return theme === 'light' || theme === 'dark' ? theme : 'system';
}

export const theme = new ThemeSwitch();
