// Poses of bodies as columns, which the engine writes.
import { ScreeError } from './engine.js';
import { structs } from './layout.js';

const BYTES = 4 + 12 + 16 + 1;
const ROOM_LEAST = 64;
const { size: STRUCT, members: MEMBERS } = structs.scree_body_columns;
/** For how many bodies an answer's buffer has room, and an engine's next answer gets it. */
const rooms = new WeakMap();

/** Sets columns of the first `count` bodies of a buffer. */
function set_columns(answer, buffer, room, count) {
  if (answer.count === count && answer.ids.buffer === buffer) return answer;
  answer.count = count;
  answer.kinds = new Uint8Array(buffer, 32 * room, count);
  answer.ids = new Uint32Array(buffer, 0, count);
  answer.positions = new Float32Array(buffer, 4 * room, 3 * count);
  answer.rotations = new Float32Array(buffer, 16 * room, 4 * count);
  rooms.set(answer, room);
  return answer;
}

/** Columns of what `fill` writes: (columns, room, count), places in the engine's memory. `into`: an earlier answer, which it becomes. */
export function read_bodies(engine, into, fill) {
  let room = rooms.get(into ?? engine) ?? ROOM_LEAST;
  if (into && !rooms.has(into)) throw new ScreeError('invalid', 'bodies are written into what bodies() has given');
  for (;;) {
    const at = engine.room(STRUCT + 4 + room * BYTES);
    const counted = at + STRUCT, begin = counted + 4;
    const columns = { size: STRUCT, ids: begin, positions: begin + 4 * room, rotations: begin + 16 * room, kinds: begin + 32 * room };
    for (const member in columns) engine.set_word(at + MEMBERS[member].at, columns[member]);
    engine.set_word(counted, 0); // an error leaves it so
    const full = fill(at, room, counted);
    const count = engine.word(counted);
    const room_for = count + (count >> 3) + ROOM_LEAST; // a little more than there are
    if (count > room || 2 * count + ROOM_LEAST < room) rooms.set(engine, room_for);
    if (count > room) {
      room = room_for;
      continue;
    }
    engine.check(full);
    // One copy of all: a buffer costs more than what is in it.
    const given = into?.ids.buffer, all = engine.view(Uint8Array, begin, room * BYTES);
    if (given?.byteLength !== all.length) return set_columns(into ?? {}, all.slice().buffer, room, count);
    new Uint8Array(given).set(all);
    return set_columns(into, given, room, count);
  }
}
