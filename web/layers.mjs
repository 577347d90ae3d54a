// Checks the layers in .dependency-cruiser.cjs. dependency-cruiser does not see imports of types in .svelte files, because
// Svelte's compiler drops them first. So it gets a copy of src/ in which each .svelte file contains only its script.
import { spawnSync } from 'node:child_process';
import { cpSync, mkdtempSync, readdirSync, readFileSync, renameSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const web = fileURLToPath(new URL('.', import.meta.url));
const copy = mkdtempSync(join(tmpdir(), 'waypost-layers-'));
try {
  cpSync(join(web, 'src'), join(copy, 'src'), { recursive: true });
  cpSync(join(web, 'wuchale.config.js'), join(copy, 'wuchale.config.js')); // a test reads it
  for (const name of readdirSync(copy, { recursive: true })) {
    if (!name.endsWith('.svelte')) continue;
    const path = join(copy, name);
    const [, script = ''] = readFileSync(path, 'utf8').match(/<script[^>]*>(.*?)<\/script>/s) ?? [];
    writeFileSync(path, script);
    renameSync(path, `${path}.ts`);
  }
  const bin = join(web, 'node_modules/.bin/depcruise');
  const config = join(web, '.dependency-cruiser.cjs');
  const { status } = spawnSync(bin, ['--config', config, 'src'], { cwd: copy, stdio: 'inherit' });
  process.exitCode = status ?? 1;
} finally {
  rmSync(copy, { recursive: true });
}
