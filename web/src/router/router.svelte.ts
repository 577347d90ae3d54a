// The router: it chooses the view from the address in the browser's address bar.
import { parseRoute, searchWith, type Route } from './route';

class Router {
  route: Route = $state.raw({ view: 'nowhere' });
  path = $state('');
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

  /** Change parameters of the address; null and '' remove a parameter. */
  ask(changes: Readonly<Record<string, string | null>>, replace = true): void {
    this.go(location.pathname + searchWith(this.search, changes), replace);
  }

  /** Follow a click on a link to another view without reloading the web app. */
  follow(event: MouseEvent): void {
    const plain = event.button === 0 && !event.ctrlKey && !event.metaKey && !event.shiftKey && !event.altKey;
    const link = event.target instanceof Element ? event.target.closest('a') : null;
    if (!plain || event.defaultPrevented || link?.target !== '') return;
    if (link.origin !== location.origin || link.hasAttribute('download') || link.pathname.startsWith('/api/'))
      return;
    event.preventDefault();
    this.go(link.pathname + link.search);
  }

  #read(): void {
    this.path = location.pathname;
    this.search = location.search;
    this.route = parseRoute(location.pathname, location.search);
  }
}

export const router = new Router();
