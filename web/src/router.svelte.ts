export type Route =
  | { readonly view: 'login' }
  | { readonly view: 'work'; readonly run: string | null }
  | { readonly view: 'runs' }
  | { readonly view: 'run'; readonly run: string }
  | { readonly view: 'gold'; readonly run: string }
  | { readonly view: 'practice' | 'people' | 'me' }
  | { readonly view: 'person'; readonly user: number }
  | { readonly view: 'nowhere' };

export function parseRoute(path: string, search: string): Route {
  const [first = '', second = '', ...rest] = path.split('/').filter(Boolean);
  if (first === 'runs' && rest.length === 1 && rest[0] === 'gold')
    return { view: 'gold', run: decoded(second) };
  if (rest.length > 0) return { view: 'nowhere' };
  if (first === 'runs' && second !== '') return { view: 'run', run: decoded(second) };
  if (first === 'people' && /^[1-9]\d{0,14}$/.test(second)) return { view: 'person', user: Number(second) };
  if (second !== '') return { view: 'nowhere' };
  if (first === 'practice' || first === 'people' || first === 'me') return { view: first };
  if (first === 'runs') return { view: 'runs' };
  if (first === 'login') return { view: 'login' };
  if (first === 'work' || first === '') return { view: 'work', run: new URLSearchParams(search).get('run') };
  return { view: 'nowhere' };
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

  constructor() {
    this.#read();
    window.addEventListener('popstate', () => this.#read());
  }

  go(address: string, replace = false): void {
    if (replace) history.replaceState(null, '', address);
    else history.pushState(null, '', address);
    window.scrollTo(0, 0);
    this.#read();
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
    this.route = parseRoute(location.pathname, location.search);
  }
}

export const router = new Router();
