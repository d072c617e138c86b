// Poses of bodies as columns, out of the engine's rows.
import { structs } from './layout.js';

const { at: ID } = structs.scree_body.members.id, { at: KIND } = structs.scree_body.members.kind;
const { at: POSITION } = structs.scree_body.members.position, { at: ROTATION } = structs.scree_body.members.rotation;
if (ID !== 0 || KIND !== 4 || POSITION !== 8 || ROTATION !== 20) throw new Error('the package takes bodies to lie otherwise');

/** Columns of the rows at a place. */
export function split_bodies(engine, at, count, bytes) {
  const words = bytes / 4;
  const whole = engine.view(Uint32Array, at, count * words), parts = engine.view(Float32Array, at, count * words);
  const bodies = {
    count, kinds: new Uint8Array(count), ids: new Uint32Array(count), positions: new Float32Array(3 * count),
    rotations: new Float32Array(4 * count),
  };
  const { ids, kinds, positions, rotations } = bodies;
  // Written out: a loop over the parts takes several times as long.
  for (let i = 0, from = 0; i < count; ++i, from += words) {
    ids[i] = whole[from];
    kinds[i] = whole[from + 1];
    positions[3 * i] = parts[from + 2];
    positions[3 * i + 1] = parts[from + 3];
    positions[3 * i + 2] = parts[from + 4];
    rotations[4 * i] = parts[from + 5];
    rotations[4 * i + 1] = parts[from + 6];
    rotations[4 * i + 2] = parts[from + 7];
    rotations[4 * i + 3] = parts[from + 8];
  }
  return bodies;
}
