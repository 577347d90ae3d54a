// The layers of src/, checked by `npm run layers`: no circular imports, and a folder imports only from layers below.

/** From the bottom to the top. Folders of one layer do not import each other. */
const LAYERS = [
  ['api', 'router', 'style'], // the server's REST API and events; addresses; colors, sizes and themes
  ['keys'], // the one list of keys, and what a key press means
  ['ui'], // what every view uses: tables, dialogs, buttons, formats, who is signed in
  ['charts', 'labels', 'player'], // charts; editors of labels; a trajectory as frames, played
  ['maze'], // the maze on a canvas
  ['render'], // what draws a state: the renderer of a domain, else pictures or text
  ['answers', 'curves', 'task'], // answers on their way to the server; learning curves; one query on the screen
  ['play', 'queries'], // a demonstration; the queries and the ledger of a run
  ['gold', 'people', 'practice', 'runs', 'work'], // the views
  ['app'], // the frame of the page; it chooses the view
];

const inFolders = (folders) => `^src/(${folders.join('|')})/`;

export default {
  forbidden: [
    {
      name: 'no-circular-imports',
      severity: 'error',
      from: {},
      to: { circular: true },
    },
    {
      name: 'every-folder-has-a-layer',
      severity: 'error',
      from: { path: '^src/', pathNot: inFolders(LAYERS.flat()) },
      to: {},
    },
    ...LAYERS.flatMap((folders, layer) =>
      folders.map((folder) => ({
        name: `${folder}-imports-only-from-below`,
        severity: 'error',
        from: { path: inFolders([folder]) },
        to: { path: '^src/', pathNot: inFolders([folder, ...LAYERS.slice(0, layer).flat()]) },
      })),
    ),
    {
      name: 'every-import-is-found',
      severity: 'error',
      from: {},
      to: { couldNotResolve: true, path: '^\\.' },
    },
  ],
  options: {
    doNotFollow: { path: 'node_modules' },
    tsPreCompilationDeps: true, // imports of types count, too
    enhancedResolveOptions: { extensions: ['.ts', '.d.ts', '.js'] },
  },
};
