// The test: a server on loopback; a client that has the ground, carves 50 times and spoils one of its own bricks, which a
// repair has to mend; a client that joins later, without ground, and looks elsewhere for a while. Both have to end with
// the server's hash.
//   node session.js SERVER PROTO
import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';

import { startServer } from './host.js';

const [server, proto] = process.argv.slice(2);
const LATE_CARVES = 20; // made when the other one joins: chunks and pieces have to come whole

/** `onCarves(number)`: as the client goes on. Resolves to whether it ended well. */
async function client(args, onCarves = () => {}) {
  const child = spawn(process.execPath, ['client.js', '--proto', proto, ...args], { stdio: ['ignore', 'pipe', 'inherit'] });
  const ended = new Promise((resolve) => child.on('close', resolve));
  createInterface({ input: child.stdout }).on('line', (line) => {
    const said = JSON.parse(line);
    if ('failure' in said) console.log(line);
    else onCarves(said.carves);
  });
  return (await ended) === 0;
}

const host = await startServer(server, ['--terrain', 'canyon', '--requests-per-second', '100']);
const port = String(host.port);
let late = false;
const join = (carves) => {
  if (carves !== LATE_CARVES) return;
  late = client(['--port', port, '--carves', '10', '--rate', '4', '--at', '2,3,4', '--seed', '8', '--wander']);
};
const carver = await client(['--port', port, '--carves', '50', '--ground', '40', '--spoil', '--seed', '7'], join);
const good = [carver, await late];
const code = await host.stop();
if (code !== 0) console.log(`the server ended with ${code}`);
process.exitCode = good.every(Boolean) && code === 0 ? 0 : 1;
