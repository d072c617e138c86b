// The test that decodes the examples of docs/protocol.md as this client does: what stands under their bytes is so.
//   node examples.js DOCUMENT PROTO
import { readFileSync } from 'node:fs';

import protobuf from 'protobufjs';

import { gameInWords, timeLeft, unpackSign } from './game.js';
import { brickHash } from './hashes.js';
import { Reader, quaternionOf, unpackBricks, unpackCoords, unpackTransforms } from './packed.js';
import { World } from './world.js';

const [document, proto] = process.argv.slice(2);
const root = new protobuf.Root().loadSync(proto, { keepCase: true });
const ServerMessage = root.lookupType('scree.wire.ServerMessage');
const ClientMessage = root.lookupType('scree.wire.ClientMessage');
const wordsOf = (coord) => `(${coord.join(', ')})`;
const hex = (number, digits) => '0x' + number.toString(16).padStart(digits, '0');

function codesInWords(codes) {
  if (codes.every((code) => code === codes[0])) return `all ${codes.length} codes ${codes[0]}`;
  return `codes ${codes.slice(0, 3).join(' ')} … ${codes.at(-1)}`;
}

function materialsInWords(materials) {
  if (materials === null) return "the ground's materials";
  return typeof materials === 'number' ? `material ${materials}` : `voxels of ${new Set(materials).size} kinds`;
}

function brickInWords({ coord, codes, materials }) {
  const hash = hex(brickHash(coord, codes, materials), 16);
  return `brick: ${wordsOf(coord)}, ${materialsInWords(materials)}, ${codesInWords(codes)}, hash ${hash}`;
}

const poseInWords = ({ id, position, rotation }) => `pose: piece ${id} ${wordsOf(position)}, rotation ${hex(rotation, 8)}`;

const decoders = {
  code: (bytes) => [`distance: ${((new Int8Array(bytes)[0] * 3) / 127).toFixed(4)} voxels`],
  varint: (bytes) => [`number: ${new Reader(bytes, 'varint').varint()}`],
  zigzag: (bytes) => [`number: ${new Reader(bytes, 'zigzag').zigzag()}`],
  coords: (bytes) => ['coords: ' + unpackCoords(bytes).map(wordsOf).join(' ')],
  bricks: (bytes) => unpackBricks(bytes).map(brickInWords),
  transforms: (bytes) => unpackTransforms(bytes).map(poseInWords),
  rotation: (bytes) => {
    const [x, y, z, w] = quaternionOf(new Reader(bytes, 'rotation').u32()).map((part) => part.toFixed(4));
    return [`quaternion: x ${x}, y ${y}, z ${z}, w ${w}`];
  },
};

/** Those of a game, of either side, in words. Returns null for others. */
function gameOf(kind, bytes) {
  const message = (kind === 'server message' ? ServerMessage : ClientMessage).decode(bytes.subarray(4));
  if (message.kind === 'signs') checkCountdown(unpackSign(message.signs.signs[0]));
  return message.kind ? gameInWords(message.kind, message[message.kind]) : null;
}

/** The page's rule for the time that is left. */
function checkCountdown(round) {
  const shown = [0n, 1n, 60n, 8641n, 8999n, 9000n].map((tick) => timeLeft(round, tick, 60));
  const stated = ['2:30', '2:30', '2:29', '0:06', '0:01', null];
  if (JSON.stringify(shown) !== JSON.stringify(stated)) throw new Error(`a countdown shows ${shown} in place of ${stated}`);
}

/** The world to which a part of a chunk came, for the next one. */
let unfinished = null;

/** Messages that change the state are applied, with their hashes and checks. Returns whether it was one. */
function applied(bytes) {
  const message = ServerMessage.decode(bytes.subarray(4));
  const world = unfinished ?? new World();
  for (const id of [3, 5, 7]) world.pieces.set(id, {}); // those of the example frame
  if (message.kind === 'piece') world.pieces.clear();
  const apply = { frame: 'frame', chunk: 'chunk', piece: 'piece', ground: 'groundOf' }[message.kind];
  if (apply === undefined) return false;
  world[apply](message[message.kind]);
  unfinished = message.chunk?.more ? world : null;
  if (world.mismatched) throw new Error('a check does not match');
  return true;
}

const blocks = [...readFileSync(document, 'utf8').matchAll(/^```example (.+)\n([^]*?)^```$/gm)];
const count = { decoded: 0, applied: 0, game: 0 };
for (const [block, kind, content] of blocks) {
  const lines = content.trimEnd().split('\n');
  const digits = lines.filter((line) => line.startsWith('bytes: ')).map((line) => line.slice(7));
  const bytes = Uint8Array.from(digits.join(' ').split(' '), (byte) => parseInt(byte, 16));
  if (kind === 'server message') count.applied += applied(bytes) ? 1 : 0;
  const game = kind === 'server message' || kind === 'client message' ? gameOf(kind, bytes) : null;
  if (!game && !(kind in decoders)) continue;
  const stated = lines.filter((line) => !line.startsWith('bytes: ')).join('\n');
  const got = (game ?? decoders[kind](bytes)).join('\n');
  if (got !== stated) throw new Error(`${block}\nis decoded here as\n${got}`);
  count[game ? 'game' : 'decoded']++;
}
console.log(JSON.stringify(count));
if (count.decoded < 10 || count.applied < 5 || count.game < 4) throw new Error('examples are missing');
