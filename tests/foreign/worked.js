// The test that runs the worked example of docs/protocol.md, a program that builds a door, against a server: the example is
// the block of the page, with a director's token. What it prints is what the page says.
//   node worked.js DOCUMENT SERVER TOKEN_PROGRAM PROTO
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';

import { startServer } from './host.js';

const [document, server, token, proto] = process.argv.slice(2);
const page = readFileSync(document, 'utf8');
const [, program, stated] = page.match(/^<!-- file: door\.js -->\n\n```js\n([^]*?)^```\n[^]*?^```text\n([^]*?)^```$/m);
writeFileSync('door.js', program);

execFileSync(token, ['key', 'world.key']);
const director = execFileSync(token, ['new', '--key', 'world.key', '--role', 'director', '--name', 'Ann']).toString().trim();
const host = await startServer(server, ['--terrain', 'flat', '--token-key', 'world.key.pub']);
const printed = execFileSync(process.execPath, ['door.js', proto, String(host.port), director], { timeout: 60000 }).toString();
console.log(printed);
if (printed !== stated) throw new Error(`the page says otherwise:\n${stated}`);
if ((await host.stop()) !== 0) throw new Error('the server did not end well');
