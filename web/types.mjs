// Writes src/api/schema.d.ts from the server's OpenAPI document. With --check, fails if the file is not current.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import openapiTS, { astToString } from 'openapi-typescript';

const root = fileURLToPath(new URL('..', import.meta.url));
const target = fileURLToPath(new URL('src/api/schema.d.ts', import.meta.url));
const venv = `${root}.venv/bin/python`;
const python = process.env.PYTHON ?? (existsSync(venv) ? venv : 'python3');

const print =
  'import json; from waypost_server.app import create_app; print(json.dumps(create_app().openapi()))';
const document = execFileSync(python, ['-c', print], {
  cwd: root,
  maxBuffer: 64 * 2 ** 20,
});
const header = "/** Generated from the server's OpenAPI document by `npm run types`. Do not edit. */\n\n";
const schema = header + astToString(await openapiTS(JSON.parse(document.toString())));

if (process.argv.includes('--check')) {
  if (!existsSync(target) || readFileSync(target, 'utf8') !== schema) {
    console.error('web/src/api/schema.d.ts is stale: run `npm run types` in web/.');
    process.exit(1);
  }
} else {
  writeFileSync(target, schema);
}
