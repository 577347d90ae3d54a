// The layers of src/, checked by `npm run layers`: no circular imports, and a folder imports only from layers below.

/** From the bottom to the top. Folders of one layer do not import each other. */
const LAYERS = [
  ['language'], // the language of the page, and its texts
  ['api', 'api/wordings', 'router', 'ui/style'], // the server's REST API and events; its standard wordings; addresses; colors, sizes and themes
  ['keys'], // the one list of keys, and what a key press means
  ['ui'], // components and formats of every view; who is signed in
  ['ui/table'], // tables and their pages
  ['charts', 'player', 'task/labels'], // charts; a trajectory as frames, played; editors of labels
  ['render/maze', 'render/boxes'], // the maze on a canvas; places in pictures, and what pointing at them does
  ['render'], // drawing a state: with the renderer of its domain, else with pictures or as text
  ['runs/curves', 'runs/queries', 'task', 'work/answers'], // learning curves; queries and ledger; one query to answer; sending
  ['play', 'review'], // demonstrations, played in the web app; given answers under review
  ['people', 'practice', 'runs', 'runs/gold', 'work'], // the views
  ['app'], // the header, and the choice of the view
];

/** The files directly in these folders. */
const inFolders = (folders) => `^src/(${folders.join('|')})/[^/]+$`;

module.exports = {
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
        name: `${folder.replace('/', '-')}-imports-only-from-below`,
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
    exclude: { path: 'src/language/(\\.wuchale/|data\\.js)' }, // made by the build
    tsPreCompilationDeps: true, // imports of types count, too
    enhancedResolveOptions: { extensions: ['.ts', '.d.ts', '.js'] },
  },
};
