// A server's program on loopback, which ends with this one.
import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';

/** Resolves to {port, stop} once it listens. `stop()` ends it, and resolves to its exit status. */
export async function startServer(program, args) {
  const child = spawn(program, ['--port', '0', ...args], { stdio: ['ignore', 'pipe', 'inherit'] });
  process.on('exit', () => child.kill('SIGKILL'));
  const ended = new Promise((resolve) => child.on('close', resolve));
  const port = await new Promise((resolve, reject) => {
    createInterface({ input: child.stdout }).once('line', (line) => resolve(JSON.parse(line).listening));
    ended.then(() => reject(new Error('the server did not start')));
  });
  const stop = () => {
    child.kill('SIGTERM');
    return ended;
  };
  return { port, stop };
}
