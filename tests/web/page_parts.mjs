// The parts of the page's client that need no canvas.
//   node page_parts.mjs BIN_DIR
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';

const run = spawnSync(process.execPath, ['--no-experimental-fetch', join(process.argv[2], 'page_parts_web.js')], { encoding: 'utf8' });
console.log(run.stdout, run.stderr);
process.exit(run.status === 0 && run.stdout.includes('all parts do as they should') ? 0 : 1);
