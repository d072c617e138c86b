// Poses of bodies as columns, which the engine writes.

const BYTES = 4 + 12 + 16 + 1;
let room = 64; // for as many as there were, in any client

/** Columns of what `fill` writes: (columns, room, count), places in the engine's memory. */
export function read_bodies(engine, fill) {
  for (;;) {
    const struct = engine.size_of('scree_body_columns');
    const at = engine.room(struct + 4 + room * BYTES);
    const ids = at + struct + 4, positions = ids + 4 * room, rotations = positions + 12 * room, kinds = rotations + 16 * room;
    engine.write('scree_body_columns', at, { size: struct, ids, kinds, positions, rotations });
    const full = fill(at, room, at + struct);
    const count = engine.word(at + struct);
    if (count > room) room = 2 * count;
    else if (engine.check(full))
      return {
        count, kinds: engine.copy(Uint8Array, kinds, count), ids: engine.copy(Uint32Array, ids, count),
        positions: engine.copy(Float32Array, positions, 3 * count), rotations: engine.copy(Float32Array, rotations, 4 * count),
      };
  }
}
