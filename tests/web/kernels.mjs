// The kernels as WebAssembly print the hashes that every compiler's print, to the letter.
//   node kernels.mjs BIN_DIR tests/golden/kernels.txt
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const [bin, golden] = process.argv.slice(2);
const run = spawnSync(process.execPath, ['--no-experimental-fetch', join(bin, 'kernels_golden_web.js')], { encoding: 'utf8' });
const wanted = readFileSync(golden, 'utf8').split('\n');
const found = run.stdout.split('\n');
wanted.forEach((line, i) => {
  if (found[i] !== line) console.error(`wanted '${line}', found '${found[i]}'`);
});
if (run.status !== 0 || run.stdout !== wanted.join('\n')) {
  console.error(run.stderr);
  process.exit(1);
}
console.log(`${wanted.length - 1} hashes are equal`);
