// The test that runs the worked example of docs/protocol.md, a program that builds a door, against a server: the example is
// the block of the page, with a director's token. What it prints is what the page says.
//   node worked.js DOCUMENT SERVER TOKEN_PROGRAM PROTO
import { execFileSync, spawn } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { createInterface } from 'node:readline';

const [document, server, token, proto] = process.argv.slice(2);
const page = readFileSync(document, 'utf8');
const [, program, stated] = page.match(/^<!-- file: door\.js -->\n\n```js\n([^]*?)^```\n[^]*?^```text\n([^]*?)^```$/m);
writeFileSync('door.js', program);

execFileSync(token, ['key', 'world.key']);
const director = execFileSync(token, ['new', '--key', 'world.key', '--role', 'director', '--name', 'Ann']).toString().trim();
const host = spawn(server, ['--port', '0', '--terrain', 'flat', '--token-key', 'world.key.pub'], {
  stdio: ['ignore', 'pipe', 'inherit'],
});
process.on('exit', () => host.kill('SIGKILL'));
const port = await new Promise((resolve, reject) => {
  createInterface({ input: host.stdout }).once('line', (line) => resolve(String(JSON.parse(line).listening)));
  host.on('close', () => reject(new Error('the server did not start')));
});
const printed = execFileSync(process.execPath, ['door.js', proto, port, director], { timeout: 60000 }).toString();
console.log(printed);
if (printed !== stated) throw new Error(`the page says otherwise:\n${stated}`);
process.exit(0);
