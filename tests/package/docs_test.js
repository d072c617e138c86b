// The programs of docs/javascript.md and of the package's own page, as a reader would run them: each ends by itself, without
// an error, and prints something.
import assert from 'node:assert/strict';
import { execFile } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { promisify } from 'node:util';

import { host } from './server.js';

const LIMIT_MS = 120000;

let server;
before(async () => { server = await host(['--terrain', 'flat']); });
after(() => server?.stop());

const programs = [];
for (const [page, fence] of [['javascript.md', 'js program'], ['node_modules/scree-client/README.md', 'js']])
  for (const [, program] of readFileSync(page, 'utf8').matchAll(new RegExp(`\`\`\`${fence}\\n([\\s\\S]*?)\`\`\``, 'g')))
    programs.push({ name: `${page}, program ${programs.length + 1}`, program });

test('the pages have programs', () => assert.ok(programs.length >= 4));

for (const { name, program } of programs)
  test(name, async (t) => {
    const file = `program_${programs.findIndex((one) => one.name === name)}.mjs`;
    writeFileSync(file, program.replaceAll('127.0.0.1:4177', `127.0.0.1:${server.port}`));
    const { stdout, stderr } = await promisify(execFile)(process.execPath, [file], { timeout: LIMIT_MS });
    t.diagnostic(stdout.trim());
    assert.equal(stderr, '');
    assert.ok(stdout.length > 0);
  });
