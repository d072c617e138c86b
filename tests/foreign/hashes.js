// Hashes of bricks and chunks, and the check of a frame: BigInts of 64 bits.
import { createXXHash3 } from 'hash-wasm';

import { BRICK_VOXELS } from './packed.js';

const hasher = await createXXHash3();
const bytes = new Uint8Array(12 + BRICK_VOXELS + BRICK_VOXELS);
const view = new DataView(bytes.buffer);

export const wrapped = (sum) => BigInt.asUintN(64, sum);

/** XXH3 of the coordinate, the codes and what is said of materials (as unpackBricks has it): nothing, a row, 512 bytes. */
export function brickHash(coord, codes, materials = null) {
  coord.forEach((number, axis) => view.setInt32(4 * axis, number, true));
  bytes.set(new Uint8Array(codes.buffer, codes.byteOffset, BRICK_VOXELS), 12);
  const said = materials === null ? [] : typeof materials === 'number' ? [materials] : materials;
  bytes.set(said, 12 + BRICK_VOXELS);
  hasher.init();
  hasher.update(bytes.subarray(0, 12 + BRICK_VOXELS + said.length));
  return BigInt('0x' + hasher.digest('hex'));
}

/** High half xor low half. */
export const folded = (sum) => Number((sum >> 32n) ^ (sum & 0xffffffffn));
