// The page's SHA-256 is Node's.
//   node sha256.mjs BIN_DIR
import { spawnSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { join } from 'node:path';

const run = spawnSync(process.execPath, ['--no-experimental-fetch', join(process.argv[2], 'sha256_web.js')], { encoding: 'utf8' });
const bytes = [];
const lines = run.stdout.trim().split('\n');
for (let i = 0; i <= 200; ++i) {
  const wanted = createHash('sha256').update(Uint8Array.from(bytes)).digest('hex');
  if (lines[i] !== wanted) {
    console.error(`${i} bytes: wanted ${wanted}, found ${lines[i]}`);
    process.exit(1);
  }
  bytes.push((i * 37) & 255);
}
