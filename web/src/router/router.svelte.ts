export type Route =
  | { readonly view: 'login' }
  | { readonly view: 'work'; readonly run: string | null }
  | RunsRoute
  | { readonly view: 'gold'; readonly run: string }
  | { readonly view: 'practice' | 'people' | 'me' }
  | { readonly view: 'person'; readonly user: number }
  | { readonly view: 'nowhere' };

export type RunsRoute =
  | { readonly view: 'runs' }
  | { readonly view: 'compare' }
  | { readonly view: 'run'; readonly run: string; readonly tab: 'overview' | 'queries' | 'ledger' }
  | { readonly view: 'query'; readonly run: string; readonly query: number };

export function parseRoute(path: string, search: string): Route {
  const [first = '', second = '', ...rest] = path.split('/').filter(Boolean);
  if (first === 'runs' && rest.length === 1 && rest[0] === 'gold')
    return { view: 'gold', run: decoded(second) };
  if (first === 'runs') return runsRoute(second, ...rest) ?? { view: 'nowhere' };
  if (rest.length > 0) return { view: 'nowhere' };
  if (first === 'people' && /^[1-9]\d{0,14}$/.test(second)) return { view: 'person', user: Number(second) };
  if (second !== '') return { view: 'nowhere' };
  if (first === 'practice' || first === 'people' || first === 'me') return { view: first };
  if (first === 'login') return { view: 'login' };
  if (first === 'work' || first === '') return { view: 'work', run: new URLSearchParams(search).get('run') };
  return { view: 'nowhere' };
}

function runsRoute(run: string, tab = '', query = '', ...more: string[]): RunsRoute | null {
  if (more.length > 0) return null;
  if (run === '') return { view: 'runs' };
  if (tab === '')
    return run === 'compare' ? { view: run } : { view: 'run', run: decoded(run), tab: 'overview' };
  if (query === '')
    return tab === 'queries' || tab === 'ledger' ? { view: 'run', run: decoded(run), tab } : null;
  if (tab !== 'queries' || !/^[1-9]\d{0,14}$/.test(query)) return null;
  return { view: 'query', run: decoded(run), query: Number(query) };
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

/** Where we are, by the address bar. */
class Router {
  route: Route = $state.raw({ view: 'nowhere' });
  search = $state('');

  constructor() {
    this.#read();
    window.addEventListener('popstate', () => this.#read());
  }

  go(address: string, replace = false): void {
    if (replace) history.replaceState(null, '', address);
    else history.pushState(null, '', address);
    if (!replace) window.scrollTo(0, 0);
    this.#read();
  }

  /** Say in the address what is shown; an empty or absent value leaves it. */
  ask(changes: Readonly<Record<string, string | null>>, replace = true): void {
    const asked = new URLSearchParams(this.search);
    for (const [name, value] of Object.entries(changes)) {
      if (value === null || value === '') asked.delete(name);
      else asked.set(name, value);
    }
    this.go(location.pathname + (asked.size > 0 ? `?${asked}` : ''), replace);
  }

  /** Follow a click on a link of this page without leaving it. */
  follow(event: MouseEvent): void {
    const plain = event.button === 0 && !event.ctrlKey && !event.metaKey && !event.shiftKey && !event.altKey;
    const link = event.target instanceof Element ? event.target.closest('a') : null;
    if (!plain || event.defaultPrevented || link === null || link.target !== '') return;
    if (link.origin !== location.origin || link.hasAttribute('download') || link.pathname.startsWith('/api/'))
      return;
    event.preventDefault();
    this.go(link.pathname + link.search);
  }

  #read(): void {
    this.search = location.search;
    this.route = parseRoute(location.pathname, location.search);
  }
}

export const router = new Router();
