// What the find dialog offers: views, runs, and the commands of the view on the screen. Pure.
import { nameOfRunState } from '../api/states';
import type { Me, Run } from '../api/types';
import type { Binding, Command } from '../keys/registry';
import { t } from '../language/language';
import type { Route } from '../router/route';

/** A line of the dialog. It opens an address, or does what a key of the view does. */
export type Entry = {
  readonly words: string;
  readonly hint: string; // beside the words; it is searched, too
} & (
  | { readonly group: 'views' | 'runs'; readonly address: string }
  | { readonly group: 'commands'; readonly command: Command; readonly key: string }
);

/** Return the name of a group of lines, as people read it. */
export function nameOfGroup(group: Entry['group']): string {
  const names: Readonly<Record<Entry['group'], string>> = {
    views: t('Go to'),
    runs: t('Runs'),
    commands: t('Here'),
  };
  return names[group];
}

/** Return the views that a user may open. */
export function viewsOf(me: Me): Entry[] {
  const views = [
    [t('Work'), t('answer questions'), '/work'],
    [t('Runs'), t('success, costs and queries'), '/runs'],
    [t('Practice'), t('with the right answers'), '/practice'],
    [t('My numbers, tokens and sessions'), me.name, '/me'],
    ...(me.role === 'admin'
      ? [
          [t('People'), t('users and their roles'), '/people'],
          [t('Audit log'), t('logins, refusals and changes'), '/people/audit'],
        ]
      : []),
  ] as const;
  return views.map(([words, hint, address]) => ({ group: 'views', words, hint, address }));
}

/** Return what can be opened of a run. */
export function placesOf(run: Run): Entry[] {
  const id = encodeURIComponent(run.id);
  const places: Entry[] = [
    { group: 'runs', words: run.name, hint: nameOfRunState(run.state), address: `/runs/${id}` },
  ];
  if (run.state === 'running')
    places.push({
      group: 'runs',
      words: run.name,
      hint: t('answer its questions'),
      address: `/work?run=${id}`,
    });
  return places;
}

/** Return the other parts of the run that is on the screen. */
export function partsOf(route: Route, me: Me): Entry[] {
  if (!('run' in route) || route.run === null || route.view === 'work' || me.role === 'annotator') return [];
  const address = `/runs/${encodeURIComponent(route.run)}`;
  const parts = [
    [t('Overview of this run'), t('success, costs and queries'), address],
    [t('Queries of this run'), t('search and filter'), `${address}/queries`],
    [t('Ledger of this run'), t('each cost'), `${address}/ledger`],
    ...(me.role === 'viewer'
      ? []
      : [
          [t('Review of this run'), t('answers, comments'), `${address}/review`],
          [t('Gold queries of this run'), t('with known answers'), `${address}/gold`],
        ]),
    [t('Compare this run with others'), t('overlay'), `/runs/compare?run=${encodeURIComponent(route.run)}`],
  ] as const;
  return parts.map(([words, hint, to]) => ({ group: 'views', words, hint, address: to }));
}

/** Return the commands of the view on the screen. */
export function commandsOf(bindings: readonly Binding[]): Entry[] {
  return bindings
    .filter(({ command, keys }) => command !== 'find' && keys.length > 0)
    .map(({ command, keys, label, group }) => ({
      group: 'commands',
      words: label,
      hint: group,
      command,
      key: keys[0] ?? '',
    }));
}

/** Return the entries that have every typed word, those first whose words begin with what was typed. */
export function matching(entries: readonly Entry[], typed: string): Entry[] {
  const wanted = typed.toLowerCase().split(/\s+/).filter(Boolean);
  const found = entries.filter(({ words, hint }) => {
    const text = `${words} ${hint}`.toLowerCase();
    return wanted.every((word) => text.includes(word));
  });
  const begins = (entry: Entry) => entry.words.toLowerCase().startsWith(typed.trim().toLowerCase());
  return [...found.filter(begins), ...found.filter((entry) => !begins(entry))];
}
