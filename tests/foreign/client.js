// A client without kernels: joins a server, mirrors chunks and pieces, asks for the ground, sends carves, paints and
// fills, and checks every hash. Exits with 0 only when all requests are answered, everything has merged, and the hash
// over all that it holds is the server's. Prints how it goes on, and at last a report, as lines of JSON.
//   node client.js --proto FILE --port N [--host H] [--eye x,y,z] [--interest M] [--carves N] [--rate HZ]
//                  [--ground M | --at x,y,z] [--spoil] [--wander] [--seed N] [--timeout S]
import { parseArgs } from 'node:util';

import Long from 'long';

import { Connection } from './connection.js';
import { checkComplete, chunksAround, surfaceBricks, surfaceIn } from './geometry.js';
import { Writer } from './packed.js';
import { Requests } from './requests.js';
import { World, bigOf, keyOf } from './world.js';

const PROTOCOL = 6;
const GROUND_WAITING_MAX = 1024;
const text = (name, fallback) => ({ [name]: { type: 'string', default: fallback } });
const { values: options } = parseArgs({
  options: {
    ...text('proto', 'scree.proto'),
    ...text('host', '127.0.0.1'),
    ...text('port', '4177'),
    ...text('eye', '6,8,0'),
    ...text('interest', '120'),
    ...text('carves', '50'),
    ...text('rate', '10'),
    ...text('ground', '0'),
    ...text('at', '2,4,0'),
    ...text('seed', '1'),
    ...text('timeout', '120'),
    spoil: { type: 'boolean', default: false },
    wander: { type: 'boolean', default: false },
  },
});
const pointOf = (words) => words.split(',').map(Number);
const eye = pointOf(options.eye);
const asPoint = ([x, y, z]) => ({ x, y, z });
const packed = (coords) => new Writer().coords(coords);
const longOf = (big) => Long.fromString(big.toString(), true);

const world = new World();
const report = { name: options.ground === '0' ? 'without ground' : 'with ground', mismatches: 0, largest_piece_voxels: 0 };
let voxelSize = 0;
let groundWanted = [];
let groundWaiting = 0;
let requests = null;
let equalStatuses = 0;

const timeout = setTimeout(() => finish(`not done within ${options.timeout} s`), 1000 * Number(options.timeout));
const connection = new Connection({ ...options, port: Number(options.port), onMessage: receive, onEnd: finish });
connection.send('hello', {
  protocol: PROTOCOL,
  client: Buffer.from('foreign client'),
  eye: asPoint(eye),
  interest_radius_m: Number(options.interest),
  name: Buffer.from(report.name),
  lacks_kernels: true,
});

function receive(kind, message) {
  const handlers = {
    welcome,
    refusal: () => finish(`refused: ${message.reason}`),
    frame,
    chunk: () => world.chunk(message),
    piece,
    prop: (message) => world.prop(message),
    reset: () => world.reset(),
    ground,
    reply: () => requests.answered(message),
    status,
  };
  handlers[kind]?.(message); // cursors and bodies are for people
}

function welcome({ terrain, protocol }) {
  if (protocol !== PROTOCOL) return finish(`protocol ${protocol}`);
  voxelSize = terrain.voxel_size_m;
  connection.sendUnknown(); // which the server skips
  groundWanted = options.ground === '0' ? [] : chunksAround(eye, Number(options.ground), voxelSize);
  askGround();
  if (groundWanted.length + groundWaiting === 0) begin();
}

/** As much as may wait at once. */
function askGround() {
  const chunks = groundWanted.splice(0, GROUND_WAITING_MAX - groundWaiting);
  if (chunks.length > 0) connection.send('ground', { chunks: packed(chunks) });
  groundWaiting += chunks.length;
}

function ground(message) {
  world.groundOf(message);
  groundWaiting--;
  if (groundWaiting < GROUND_WAITING_MAX / 2) askGround();
  if (groundWaiting === 0) begin();
}

function begin() {
  report.ground_faces = checkComplete(world);
  const bricks = surfaceBricks(world, eye, 12, voxelSize);
  const onSurface = (random) => surfaceIn(world, bricks[Math.floor(random() * bricks.length)], voxelSize);
  requests = new Requests({
    connection,
    count: Number(options.carves),
    rate: Number(options.rate),
    seed: Number(options.seed),
    place: bricks.length > 0 ? onSurface : () => pointOf(options.at),
    onCarve: beforeCarve,
  });
}

/** Returns whether the carve has to be right at the place. */
function beforeCarve(place, number) {
  if (number % 10 === 0) console.log(JSON.stringify({ name: report.name, carves: number }));
  if (options.wander && number === 3) look([eye[0] + 1000, eye[1], eye[2]]);
  if (options.wander && number === 7) look(eye);
  if (!options.spoil || number < 20 || report.spoiled) return false;
  report.spoiled = world.spoil(place.map((number) => number / voxelSize));
  return report.spoiled;
}

/** It goes on carving where it stood: the server measures its reach from the eye that was told last. */
function look(from) {
  connection.send('interest', { eye: asPoint(from), radius_m: Number(options.interest) });
  connection.send('cursor', { eye: asPoint(eye), aim: asPoint(eye) });
}

function frame(message) {
  world.frame(message);
  const wrong = world.mismatched;
  world.mismatched = null;
  if (!wrong) return;
  report.mismatches++;
  connection.send('repair', {
    tick: longOf(wrong.tick),
    chunks: packed(wrong.chunks),
    hashes: wrong.chunks.map((chunk) => longOf(world.chunkHash(keyOf(chunk)))),
  });
}

function piece(message) {
  world.piece(message);
  report.largest_piece_voxels = Math.max(report.largest_piece_voxels, world.pieces.get(message.id).volume.codes.length);
}

/** The server's hash of the whole field, in the tick of the frame before. Comes once a second. */
function status({ tick, pieces, field_hash, pieces_merged }) {
  connection.send('ack', { tick });
  if (!requests?.done() || pieces !== 0) return void (equalStatuses = 0);
  equalStatuses = world.fieldHash() === bigOf(field_hash) ? equalStatuses + 1 : 0;
  if (equalStatuses < 2) return;
  report.pieces_merged = Number(bigOf(pieces_merged));
  report.field_hash = world.fieldHash().toString(16);
  finish(shortcomings());
}

/** What a whole session has to have had; null when nothing is missing. */
function shortcomings() {
  if (world.pieces.size !== 0) return `${world.pieces.size} pieces are left`;
  if (world.counts.pieces === 0 || report.pieces_merged === 0) return 'no piece came, or none merged';
  if (world.counts.checks === 0) return 'no check came';
  if (options.spoil && report.mismatches === 0) return 'a spoiled brick was not noticed';
  if (!options.spoil && report.mismatches !== 0) return `${report.mismatches} checks failed`;
  if (options.wander && world.counts.dropped === 0) return 'nothing was dropped';
  if (world.counts.beyond !== 0) return 'ground within the interest was refused';
  return null;
}

function finish(failure) {
  clearTimeout(timeout);
  requests?.stop();
  connection.onEnd = null;
  connection.end();
  Object.assign(report, world.counts, requests?.counts, {
    received_bytes: connection.receivedBytes,
    bytes: connection.bytesByKind,
    failure,
  });
  console.log(JSON.stringify(report));
  process.exitCode = failure === null ? 0 : 1;
}
