// Programs of this project on loopback, for a test: started, spoken of by their own lines, and ended by their own process.
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { join } from 'node:path';
import { createInterface } from 'node:readline';

/** The folder of the built programs, and the built page. */
export const PROGRAMS = process.env.SCREE_PROGRAMS, DIST = process.env.SCREE_DIST;
const START_MS = 60000, END_MS = 30000;

const running = new Set();
process.on('exit', () => running.forEach((child) => child.kill('SIGKILL')));

function start(name, options, stdio) {
  const child = spawn(join(PROGRAMS, name), options, { stdio });
  running.add(child);
  child.on('close', () => running.delete(child));
  return child;
}

/** A server with the page; `port` 0: a free one. `program`: another one that takes the server's options. */
export async function host(options, port = 0, program = 'scree-server') {
  const child = start(program, ['--port', String(port), '--web', DIST, ...options], ['ignore', 'pipe', 'ignore']);
  const ended = once(child, 'close');
  const first = once(createInterface({ input: child.stdout }), 'line', { signal: AbortSignal.timeout(START_MS) });
  const [line] = await Promise.race([first, ended.then(() => { throw new Error(`${program} ${options.join(' ')} did not start`); })]);
  const { listening } = JSON.parse(line);
  return {
    port: listening, url: `http://127.0.0.1:${listening}/`,
    async stop(signal = 'SIGTERM') {
      child.kill(signal);
      await Promise.race([ended, new Promise((_, reject) => { setTimeout(() => reject(new Error('the server did not end')), END_MS).unref(); })]);
    },
  };
}

/** Runs a program to its end; fails where it does. */
export async function run(name, options, limit_ms = 180000) {
  const child = start(name, options, ['ignore', 'ignore', 'pipe']);
  let said = '';
  child.stderr.on('data', (data) => { said += data; });
  const limit = setTimeout(() => child.kill('SIGKILL'), limit_ms);
  const [code] = await once(child, 'close');
  clearTimeout(limit);
  if (code !== 0) throw new Error(`${name} ${options.join(' ')} ended with ${code}: ${said.slice(-2000)}`);
}
