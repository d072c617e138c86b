// The packed fields of proto/scree.proto (its notation: varint, zigzag, u32, f32, coords), and what lies in them:
// bricks, volumes, poses. Everything that is read is checked; a breach throws.
import { decompress } from 'fzstd';

export const BRICK_VOXELS = 512;
export const SIDE_MAX = 128;
const MIXED = 255; // where a material stands: each voxel says its own

export class Reader {
  constructor(bytes, subject) {
    this.bytes = bytes;
    this.subject = subject;
    this.next = 0;
  }

  fail(why) {
    throw new Error(`${this.subject}: ${why}`);
  }

  atEnd() {
    return this.next === this.bytes.length;
  }

  take(count) {
    if (this.next + count > this.bytes.length) this.fail('ends too soon');
    this.next += count;
    return this.bytes.subarray(this.next - count, this.next);
  }

  rest() {
    return this.take(this.bytes.length - this.next);
  }

  u8() {
    return this.take(1)[0];
  }

  u32() {
    const [a, b, c, d] = this.take(4);
    return (a | (b << 8) | (c << 16) | (d << 24)) >>> 0;
  }

  f32() {
    const part = this.take(4);
    const value = new DataView(part.buffer, part.byteOffset, 4).getFloat32(0, true);
    if (!Number.isFinite(value)) this.fail('a float is not finite');
    return value;
  }

  /** A BigInt of at most 64 bits. */
  varint() {
    let value = 0n;
    for (let i = 0n; i < 10n; i++) {
      const byte = this.u8();
      value |= BigInt(byte & 0x7f) << (7n * i);
      if (byte < 0x80) return value;
    }
    return this.fail('a varint of more than 10 bytes');
  }

  /** A number of 0 to max. */
  count(max) {
    const value = this.varint();
    if (value > BigInt(max)) this.fail(`${value} is over ${max}`);
    return Number(value);
  }

  zigzag() {
    const folded = this.varint();
    return Number((folded >> 1n) ^ -(folded & 1n));
  }

  /** [x, y, z] after the coordinate before. */
  coord(before) {
    return before.map((from) => from + this.zigzag());
  }

  /** One zstd frame that fills the rest: so many codes, then so many bytes of materials. */
  voxels(count, materialCount = 0) {
    const bytes = new Uint8Array(count + materialCount);
    const got = decompress(this.rest(), bytes);
    if (got.length !== bytes.length) this.fail(`${got.length} bytes of voxels instead of ${bytes.length}`);
    const codes = bytes.subarray(0, count);
    if (codes.includes(0x80)) this.fail('a code is -128');
    return { codes: new Int8Array(bytes.buffer, 0, count), materials: bytes.subarray(count) };
  }
}

export class Writer {
  constructor() {
    this.bytes = [];
  }

  varint(value) {
    let left = BigInt(value);
    for (; left >= 0x80n; left >>= 7n) this.bytes.push(Number(left & 0x7fn) | 0x80);
    this.bytes.push(Number(left));
  }

  zigzag(value) {
    const n = BigInt(value);
    this.varint(n < 0n ? -2n * n - 1n : 2n * n);
  }

  coords(list) {
    let before = [0, 0, 0];
    for (const coord of list) {
      coord.forEach((to, axis) => this.zigzag(to - before[axis]));
      before = coord;
    }
    return Uint8Array.from(this.bytes);
  }
}

export function unpackCoords(bytes) {
  const reader = new Reader(bytes, 'coords');
  const list = [];
  for (let before = [0, 0, 0]; !reader.atEnd(); ) list.push((before = reader.coord(before)));
  return list;
}

/**
 * Frame.patches, Chunk.bricks and Ground.bricks: [{coord, codes, materials}]. Materials: null for the ground's own, a row of
 * the palette, or 512 bytes, for each voxel 0 for the ground's own or 1 + row.
 */
export function unpackBricks(bytes) {
  if (bytes.length === 0) return [];
  const reader = new Reader(bytes, 'bricks');
  const count = reader.count(4096);
  const bricks = [];
  for (let i = 0, before = [0, 0, 0]; i < count; i++) {
    before = reader.coord(before);
    bricks.push({ coord: before, codes: null, materials: null });
  }
  let next = 0;
  for (let said = reader.count(count); said > 0; said--) {
    next += reader.count(count);
    if (next >= count) reader.fail('a material beyond the last brick');
    bricks[next++].materials = reader.u8();
  }
  const mixed = bricks.filter(({ materials }) => materials === MIXED);
  const voxels = reader.voxels(count * BRICK_VOXELS, mixed.length * BRICK_VOXELS);
  const ofBrick = (all, i) => all.subarray(i * BRICK_VOXELS, (i + 1) * BRICK_VOXELS);
  bricks.forEach((brick, i) => (brick.codes = ofBrick(voxels.codes, i)));
  mixed.forEach((brick, i) => (brick.materials = ofBrick(voxels.materials, i)));
  return bricks;
}

/** The masses of a volume of several materials, by row. */
function unpackMasses(reader, mass) {
  const masses = new Map();
  for (let left = reader.count(MIXED), last = -1; left > 0; left--) {
    const row = reader.u8();
    if (row <= last) reader.fail('materials out of order');
    masses.set((last = row), reader.varint());
  }
  const sum = [...masses.values()].reduce((a, b) => a + b, 0n);
  if (sum !== mass) reader.fail(`masses of ${sum} in a volume of ${mass}`);
  return masses;
}

/** Piece.volume. `materials`: the row of each voxel, or null where all are of the first of `masses`. */
export function unpackVolume(bytes) {
  const reader = new Reader(bytes, 'volume');
  const first = reader.coord([0, 0, 0]);
  const size = [0, 0, 0].map(() => reader.count(SIDE_MAX));
  const mass = reader.varint();
  const centre = [0, 0, 0].map(() => reader.f32());
  const material = reader.u8();
  const isMixed = material === MIXED;
  const masses = isMixed ? unpackMasses(reader, mass) : new Map([[material, mass]]);
  const count = size[0] * size[1] * size[2];
  const { codes, materials } = reader.voxels(count, isMixed ? count : 0);
  return { first, size, mass, centre, masses, codes, materials: isMixed ? materials : null };
}

/** Store.masses: the mass by row. */
export function unpackStoreMasses(bytes) {
  const reader = new Reader(bytes, 'masses of a store');
  const masses = new Map();
  for (let last = -1; !reader.atEnd(); ) {
    const row = reader.u8();
    if (row <= last) reader.fail('materials out of order');
    masses.set((last = row), reader.varint());
    if (masses.get(row) === 0n) reader.fail('a mass of 0');
  }
  return masses;
}

/** Frame.removed_pieces. */
export function unpackIds(bytes) {
  const reader = new Reader(bytes, 'removed pieces');
  const ids = [];
  for (let id = 0; !reader.atEnd(); ) ids.push((id += reader.zigzag()));
  return ids;
}

/** Frame.transforms: [{id, position (steps of 1/1024 m), rotation (32 bits)}]. */
export function unpackTransforms(bytes) {
  const reader = new Reader(bytes, 'transforms');
  const poses = [];
  for (let id = 0, position = [0, 0, 0]; !reader.atEnd(); ) {
    id += reader.count(0xffffffff);
    position = reader.coord(position);
    poses.push({ id, position, rotation: reader.u32() });
  }
  return poses;
}

/** The unit quaternion [x, y, z, w] of a rotation's 32 bits. */
export function quaternionOf(rotation) {
  const largest = rotation >>> 30;
  const q = [0, 0, 0, 0];
  let sum = 0;
  for (let i = 0, shift = 20; i < 4; i++) {
    if (i === largest) continue;
    q[i] = ((((rotation >>> shift) & 1023) / 1023) * 2 - 1) * Math.SQRT1_2;
    shift -= 10;
    sum += q[i] * q[i];
  }
  q[largest] = Math.sqrt(Math.max(0, 1 - sum));
  const length = Math.hypot(...q);
  return q.map((part) => part / length);
}
