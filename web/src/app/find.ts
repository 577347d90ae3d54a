// What the find dialog offers: views, runs, and the commands of the view on the screen. Pure.
import type { Me, Run } from '../api/types';
import type { Binding, Command } from '../keys/registry';

/** A line of the dialog. It opens an address, or does what a key of the view does. */
export type Entry = {
  readonly words: string;
  readonly hint: string; // beside the words; it is searched, too
} & (
  | { readonly group: 'Go to' | 'Runs'; readonly address: string }
  | { readonly group: 'Here'; readonly command: Command; readonly key: string }
);

/** Return the views that a user may open. */
export function viewsOf(me: Me): Entry[] {
  const views = [
    ['Work', 'answer questions', '/work'],
    ['Runs', 'success, costs and queries', '/runs'],
    ['Practice', 'with the right answers', '/practice'],
    ['My numbers, tokens and sessions', me.name, '/me'],
    ...(me.role === 'admin'
      ? [
          ['People', 'users and their roles', '/people'],
          ['Audit log', 'logins, refusals and changes', '/people/audit'],
        ]
      : []),
  ] as const;
  return views.map(([words, hint, address]) => ({ group: 'Go to', words, hint, address }));
}

/** Return what can be opened of a run. */
export function placesOf(run: Run): Entry[] {
  const id = encodeURIComponent(run.id);
  const places: Entry[] = [{ group: 'Runs', words: run.name, hint: run.state, address: `/runs/${id}` }];
  if (run.state === 'running')
    places.push({ group: 'Runs', words: run.name, hint: 'answer its questions', address: `/work?run=${id}` });
  return places;
}

/** Return the commands of the view on the screen. */
export function commandsOf(bindings: readonly Binding[]): Entry[] {
  return bindings
    .filter(({ command, keys }) => command !== 'find' && keys.length > 0)
    .map(({ command, keys, label, group }) => ({
      group: 'Here',
      words: label,
      hint: group.toLowerCase(),
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
