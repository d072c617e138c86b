// Hashes of bricks and chunks, and the check of a frame: BigInts of 64 bits.
import { createXXHash3 } from 'hash-wasm';

import { BRICK_VOXELS } from './packed.js';

const hasher = await createXXHash3();
const bytes = new Uint8Array(12 + BRICK_VOXELS + 8);
const view = new DataView(bytes.buffer);

export const wrapped = (sum) => BigInt.asUintN(64, sum);

const xxh3 = (content) => BigInt('0x' + hasher.init().update(content).digest('hex'));

/** XXH3 of the coordinate, the codes and what is said of materials (as unpackBricks has it): nothing, a row, or the hash of 512 bytes. */
export function brickHash(coord, codes, materials = null) {
  coord.forEach((number, axis) => view.setInt32(4 * axis, number, true));
  bytes.set(new Uint8Array(codes.buffer, codes.byteOffset, BRICK_VOXELS), 12);
  const end = 12 + BRICK_VOXELS;
  if (materials === null) return xxh3(bytes.subarray(0, end));
  if (typeof materials === 'number') {
    bytes[end] = materials;
    return xxh3(bytes.subarray(0, end + 1));
  }
  view.setBigUint64(end, xxh3(materials), true);
  return xxh3(bytes);
}

/** High half xor low half. */
export const folded = (sum) => Number((sum >> 32n) ^ (sum & 0xffffffffn));
