// Poses of bodies as columns, which the engine writes.
import { structs } from './layout.js';

const BYTES = 4 + 12 + 16 + 1;
const ROOM_LEAST = 64;
const { size: STRUCT, members: MEMBERS } = structs.scree_body_columns;
/** For how many bodies an engine's columns have room: a little more than there were. */
const rooms = new WeakMap();

/** Columns of what `fill` writes: (columns, room, count), places in the engine's memory. */
export function read_bodies(engine, fill) {
  for (;;) {
    const room = rooms.get(engine) ?? ROOM_LEAST;
    const at = engine.room(STRUCT + 4 + room * BYTES);
    const counted = at + STRUCT, begin = counted + 4;
    const positions = begin + 4 * room, rotations = begin + 16 * room, kinds = begin + 32 * room;
    const columns = { size: STRUCT, ids: begin, positions, rotations, kinds };
    for (const member in columns) engine.set_word(at + MEMBERS[member].at, columns[member]);
    engine.set_word(counted, 0); // an error leaves it so
    const full = fill(at, room, counted);
    const count = engine.word(counted);
    if (count > room || 2 * count + ROOM_LEAST < room) rooms.set(engine, count + (count >> 3) + ROOM_LEAST);
    if (count > room) continue;
    engine.check(full);
    // One copy of all: a buffer costs more than what is in it.
    const buffer = engine.memory.buffer.slice(begin, begin + room * BYTES);
    return {
      count, kinds: new Uint8Array(buffer, 32 * room, count), ids: new Uint32Array(buffer, 0, count),
      positions: new Float32Array(buffer, 4 * room, 3 * count),
      rotations: new Float32Array(buffer, 16 * room, 4 * count),
    };
  }
}
