// What the package says of itself: its types, and its size.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { brotliCompressSync, constants } from 'node:zlib';

import { connect, ScreeError } from 'scree-client';

const FOLDER = 'node_modules/scree-client', CODE_BYTES_MAX = 400 * 1024;

test('the types compile, and refuse what is wrong', () => {
  execFileSync(process.execPath, [join(process.cwd(), '..', 'node_modules', 'typescript', 'bin', 'tsc'), '--noEmit', '--strict', '--target', 'es2022',
    '--module', 'nodenext', '--lib', 'es2022,dom', 'types.ts'], { stdio: 'inherit' });
});

test('the types have the methods that clients have', async () => {
  const { Client } = await import(join(process.cwd(), FOLDER, 'client.js'));
  const text = readFileSync(join(FOLDER, 'index.d.ts'), 'utf8');
  const body = /export class Client \{([\s\S]*?)\n\}/.exec(text)[1];
  const told = [...body.matchAll(/^ {2}(?:readonly )?(\w+)[(:]/gm)].map(([, name]) => name).filter((name) => name !== 'constructor');
  const made = Object.getOwnPropertyNames(Client.prototype).filter((name) => !['constructor', 'request'].includes(name));
  assert.deepEqual([...new Set(told)].sort(), made.sort());
  assert.equal(typeof connect, 'function');
  assert.ok(new ScreeError('refused', 'no') instanceof Error);
});

// As web_package.mjs counts it.
test('wasm and scripts are at most 400 KiB by Brotli', (t) => {
  const params = { [constants.BROTLI_PARAM_LGWIN]: constants.BROTLI_MAX_WINDOW_BITS };
  const sizes = readdirSync(FOLDER).filter((name) => /\.(js|wasm)$/.test(name))
    .map((name) => brotliCompressSync(readFileSync(join(FOLDER, name)), { params }).length);
  const total = sizes.reduce((sum, size) => sum + size, 0);
  t.diagnostic(`${total} bytes`);
  assert.ok(total <= CODE_BYTES_MAX, `${total} bytes`);
});
