// Hashes of bricks and chunks, and the check of a frame: BigInts of 64 bits.
import { createXXHash3 } from 'hash-wasm';

import { BRICK_VOXELS } from './packed.js';

const hasher = await createXXHash3();
const bytes = new Uint8Array(12 + BRICK_VOXELS + 1);
const view = new DataView(bytes.buffer);

export const wrapped = (sum) => BigInt.asUintN(64, sum);

/** XXH3 of the coordinate, the codes and, where there is paint, the material. */
export function brickHash(coord, codes, paint = null) {
  coord.forEach((number, axis) => view.setInt32(4 * axis, number, true));
  bytes.set(new Uint8Array(codes.buffer, codes.byteOffset, BRICK_VOXELS), 12);
  bytes[12 + BRICK_VOXELS] = paint ?? 0;
  hasher.init();
  hasher.update(bytes.subarray(0, 12 + BRICK_VOXELS + (paint === null ? 0 : 1)));
  return BigInt('0x' + hasher.digest('hex'));
}

/** High half xor low half. */
export const folded = (sum) => Number((sum >> 32n) ^ (sum & 0xffffffffn));
