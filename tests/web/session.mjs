// A page's session as WebAssembly beside a server's program on loopback: 50 carves, each shown before the server has
// answered, all pieces merge, and the mirror's hash is the server's. A second session comes back to the same world.
//   node session.mjs BIN_DIR SCREE_SERVER
import { spawn } from 'node:child_process';
import { connect } from 'node:net';
import { createRequire } from 'node:module';
import { join, resolve as resolvePath } from 'node:path';
import { createInterface } from 'node:readline';

const [bin, program] = process.argv.slice(2);
const CARVES = 50;
const PATIENCE_MS = 90_000;
const createModule = createRequire(import.meta.url)(join(resolvePath(bin), 'mirror_session_web.js'));
const fail = (why) => {
  console.error(why);
  process.exit(1);
};

const server = spawn(program, ['--port', '0', '--terrain', 'flat', '--requests-per-second', '100'], { stdio: ['ignore', 'pipe', 'pipe'] });
process.on('exit', () => server.kill('SIGKILL'));
let log = '';
server.stderr.on('data', (bytes) => (log += bytes));
server.on('exit', () => fail(`the server has ended: ${log}`));
// Its first line.
const port = await new Promise((resolve) =>
  createInterface({ input: server.stdout }).once('line', (line) => resolve(JSON.parse(line).listening)),
);

const session = await createModule();
let socket = null;
/// What a page does with its WebSocket, by TCP: the server reads the same stream of bytes from either.
const tend = () => {
  const wish = session._scree_socket_wish();
  if (wish === 2 && socket) socket.destroy();
  if (wish === 1) {
    const opened = connect(port, '127.0.0.1');
    socket = opened;
    opened.setNoDelay();
    opened.on('connect', () => session._scree_socket_opened());
    opened.on('data', (bytes) => {
      session.HEAPU8.set(bytes, session._scree_incoming(bytes.length));
      session._scree_received(bytes.length);
    });
    opened.on('error', () => {});
    opened.on('close', () => {
      if (socket === opened) session.ccall('scree_socket_closed', null, ['string'], ['']);
    });
  }
  session._session_step();
  const bytes = session._scree_outgoing();
  const at = session._scree_outgoing_bytes();
  if (bytes > 0) socket.write(session.HEAPU8.slice(at, at + bytes));
  return JSON.parse(session.UTF8ToString(session._session_report()));
};
const begun = Date.now();
const until = async (what, condition) => {
  while (true) {
    const report = tend();
    if (condition(report)) return report;
    if (Date.now() - begun > PATIENCE_MS) fail(`${what} does not come: ${JSON.stringify(report)}\n${log}`);
    await new Promise((resolve) => setTimeout(resolve, 4));
  }
};
// Some pieces break on their way, so that fewer merge than were made.
const quiet = (report) => report.predictions === 0 && report.pieces === 0 && report.server_pieces === 0;

session._session_begin(0, 6, 0, 60, 1);
await until('the world', (report) => report.joined);
let predicted = 0;
for (let i = 0; i < CARVES; ++i) {
  const angle = i * 2.4;
  const away = 1.5 * Math.sqrt(i);
  session._session_strike(away * Math.cos(angle), 5, away * Math.sin(angle), 0.8 + 0.02 * i, 6 + (i % 20));
  predicted += JSON.parse(session.UTF8ToString(session._session_report())).predictions > 0 ? 1 : 0;
  const next = Date.now() + 60;
  await until('time', () => Date.now() >= next);
}
const end = await until('rest', (report) => quiet(report) && report.pieces_merged > CARVES && report.field_hash === report.server_hash);
if (end.mismatches !== 0) fail(`${end.mismatches} checks failed: ${JSON.stringify(end)}`);
if (end.checks === 0 || predicted === 0) fail(`nothing was checked, or foreseen: ${JSON.stringify(end)}`);
if (end.field_hash === '0000000000000000') fail('nothing was carved');
console.log(JSON.stringify({ ...end, predicted }));

// Lost, it comes back by itself to the same state.
socket.destroy();
await until('the loss', (report) => report.text !== undefined || report.checks === 0);
const again = await until('the world again', (report) => report.joined && report.field_hash === report.server_hash);
if (again.field_hash !== end.field_hash) fail(`another world: ${JSON.stringify(again)}`);
process.exit(0);
