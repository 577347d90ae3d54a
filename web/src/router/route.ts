// Addresses: the view that an address leads to, and its parameters. Pure.

export type Route =
  | { readonly view: 'login' }
  | WorkRoute
  | RunsRoute
  | { readonly view: 'gold'; readonly run: string }
  | { readonly view: 'people' | 'audit' | 'me' }
  | PracticeRoute
  | { readonly view: 'person'; readonly user: number }
  | { readonly view: 'nowhere' };

/** The work view: the queries of one run, or of all; without one kind, or of every kind. */
export interface WorkRoute {
  readonly view: 'work';
  readonly run: string | null;
  readonly without: string | null;
}

/** Practice. The first one of a person is short, and leads to a work view. */
export interface PracticeRoute {
  readonly view: 'practice';
  readonly first: boolean;
  readonly run: string | null; // the only one of that work view; null for all
  readonly work: string; // the address of that work view
}

export type RunsRoute =
  | { readonly view: 'runs' }
  | { readonly view: 'compare' }
  | { readonly view: 'run'; readonly run: string; readonly section: Section }
  | { readonly view: 'query'; readonly run: string; readonly query: number };

/** The parts of the view of a run. */
export type Section = 'overview' | 'queries' | 'review' | 'ledger';

export function parseRoute(path: string, search: string): Route {
  const [first = '', second = '', ...rest] = path.split('/').filter(Boolean);
  if (first === 'runs' && rest.length === 1 && rest[0] === 'gold')
    return { view: 'gold', run: decoded(second) };
  if (first === 'runs') return runsRoute(second, ...rest) ?? { view: 'nowhere' };
  if (rest.length > 0) return { view: 'nowhere' };
  if (first === 'people' && /^[1-9]\d{0,14}$/.test(second)) return { view: 'person', user: Number(second) };
  if (first === 'people' && second === 'audit') return { view: 'audit' };
  if (second !== '') return { view: 'nowhere' };
  if (first === 'people' || first === 'me') return { view: first };
  if (first === 'practice') return practiceRoute(search);
  if (first === 'login') return { view: 'login' };
  if (first === 'work' || first === '') {
    const parameters = new URLSearchParams(search);
    return { view: 'work', run: parameters.get('run'), without: parameters.get('without') };
  }
  return { view: 'nowhere' };
}

function practiceRoute(search: string): PracticeRoute {
  const parameters = new URLSearchParams(search);
  const work = `/work${searchWith(search, { first: null })}`;
  return { view: 'practice', first: parameters.has('first'), run: parameters.get('run'), work };
}

function runsRoute(run: string, section = '', query = '', ...more: string[]): RunsRoute | null {
  if (more.length > 0) return null;
  if (run === '') return { view: 'runs' };
  if (section === '')
    return run === 'compare' ? { view: run } : { view: 'run', run: decoded(run), section: 'overview' };
  if (query === '')
    return section === 'queries' || section === 'review' || section === 'ledger'
      ? { view: 'run', run: decoded(run), section }
      : null;
  if (section !== 'queries' || !/^[1-9]\d{0,14}$/.test(query)) return null;
  return { view: 'query', run: decoded(run), query: Number(query) };
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

/** Return the search part of an address with some parameters changed; null and '' remove a parameter. */
export function searchWith(
  search: string,
  changes: Readonly<Record<string, string | readonly string[] | null>>,
): string {
  const parameters = new URLSearchParams(search);
  for (const [name, value] of Object.entries(changes)) {
    parameters.delete(name);
    for (const one of [value ?? []].flat()) if (one !== '') parameters.append(name, one);
  }
  return parameters.size > 0 ? `?${parameters.toString()}` : '';
}

/** Return a parameter as a whole number, or null if it is not one. */
export function wholeNumber(text: string | null): number | null {
  return text !== null && /^\d{1,15}$/.test(text) ? Number(text) : null;
}
