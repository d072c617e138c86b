// A copy of the world without kernels: ground as generated, edited bricks over it, and pieces.
import { brickHash, folded, wrapped } from './hashes.js';
import { BRICK_VOXELS, unpackBricks, unpackCoords, unpackIds, unpackTransforms, unpackVolume, Reader } from './packed.js';

const AIR = new Int8Array(BRICK_VOXELS).fill(127);
const ROCK = new Int8Array(BRICK_VOXELS).fill(-127);

export const keyOf = (coord) => coord.join(',');
export const chunkOf = (brick) => brick.map((number) => number >> 2);
export const bigOf = (long) => BigInt.asUintN(64, (BigInt(long.high) << 32n) | BigInt(long.low >>> 0));
const brickInChunk = ([x, y, z], i) => [4 * x + (i >> 4), 4 * y + ((i >> 2) & 3), 4 * z + (i & 3)];

const indexInChunk = ([x, y, z]) => BigInt(16 * (x & 3) + 4 * (y & 3) + (z & 3));

class Failure extends Error {}
const demand = (holds, why) => {
  if (!holds) throw new Failure(why);
};

export class World {
  edits = new Map(); // by chunk: {hash, bricks by coordinate: {coord, codes, materials, hash}}
  ground = new Map(); // codes by brick, of every chunk in groundChunks
  groundChunks = new Map(); // by chunk: its coordinate
  pieces = new Map(); // by id: {volume, position, rotation}
  tick = 0n;
  counts = {
    frames: 0,
    patched: 0,
    checks: 0,
    chunks: 0,
    parts: 0,
    dropped: 0,
    pieces: 0,
    removed: 0,
    poses: 0,
    ground: 0,
    beyond: 0,
    resets: 0,
  };
  mismatched = null; // the chunks of a frame whose check failed: {tick, chunks}

  // ---- messages

  /** In the order of the specification: operations (none), patches, check, drops, removals, transforms. */
  frame({ changes, patches, dropped_chunks, removed_pieces, transforms }) {
    const reader = new Reader(changes, 'changes');
    const head = reader.varint();
    const check = head & 1n ? reader.u32() : null;
    demand(reader.atEnd(), 'operations came to a client without kernels');
    demand(head >> 1n >= this.tick, 'a frame of an earlier tick');
    this.tick = head >> 1n;
    this.patch(unpackBricks(patches), check);
    for (const chunk of unpackCoords(dropped_chunks)) {
      this.edits.delete(keyOf(chunk));
      this.counts.dropped++;
    }
    for (const id of unpackIds(removed_pieces)) {
      demand(this.pieces.delete(id), `piece ${id} ends, but is not known`);
      this.counts.removed++;
    }
    for (const { id, position, rotation } of unpackTransforms(transforms)) {
      demand(this.pieces.has(id), `a pose of piece ${id}, which is not known`);
      Object.assign(this.pieces.get(id), { position, rotation });
      this.counts.poses++;
    }
    this.counts.frames++;
  }

  patch(bricks, check) {
    const changed = new Map();
    for (const brick of bricks) {
      const chunk = chunkOf(brick.coord);
      changed.set(keyOf(chunk), chunk);
      this.edit(keyOf(chunk), brick);
    }
    this.counts.patched += bricks.length;
    if (check === null) return;
    demand(changed.size > 0, 'a check over no chunk');
    this.counts.checks++;
    let sum = 0n;
    for (const key of changed.keys()) sum += this.chunkHash(key);
    if (folded(wrapped(sum)) !== check) this.mismatched = { tick: this.tick, chunks: [...changed.values()] };
  }

  /** The whole chunk, or a part: what it does not list stays, as long as the server has edits there. */
  chunk({ chunk, bricks, hash, edited, more }) {
    const key = keyOf(unpackCoords(chunk)[0]);
    const isPart = bigOf(edited) !== 0n;
    if (isPart) this.forgetAllBut(bigOf(edited), key);
    else this.edits.delete(key);
    for (const brick of unpackBricks(bricks)) {
      demand(keyOf(chunkOf(brick.coord)) === key, 'a brick of another chunk');
      this.edit(key, brick);
    }
    if (isPart) this.counts.parts++;
    if (more) return;
    this.counts.chunks++;
    if (this.chunkHash(key) === bigOf(hash)) return;
    demand(isPart, `chunk ${key} does not have the hash that came with it`);
    this.mismatched = { tick: this.tick, chunks: [unpackCoords(chunk)[0]] };
  }

  forgetAllBut(edited, key) {
    const kept = [...(this.edits.get(key)?.bricks.values() ?? [])].filter(({ coord }) => (edited >> indexInChunk(coord)) & 1n);
    this.edits.delete(key);
    for (const brick of kept) this.edit(key, brick);
  }

  groundOf({ chunk, beyond, rock, bricks, hash }) {
    const coord = unpackCoords(chunk)[0];
    if (beyond) return void this.counts.beyond++;
    const listed = new Map(unpackBricks(bricks).map((brick) => [keyOf(brick.coord), brick.codes]));
    let sum = 0n;
    for (let i = 0; i < 64; i++) {
      const brick = brickInChunk(coord, i);
      const codes = listed.get(keyOf(brick)) ?? ((bigOf(rock) >> BigInt(i)) & 1n ? ROCK : AIR);
      this.ground.set(keyOf(brick), codes);
      sum += brickHash(brick, codes);
    }
    demand(wrapped(sum) === bigOf(hash), `the ground of chunk ${coord} does not have the hash that came with it`);
    this.groundChunks.set(keyOf(coord), coord);
    this.counts.ground++;
  }

  /** A prop of a game: its ids are from the same numbers, so it is moved and removed as a piece is. */
  prop({ id, prop, x, y, z, rotation }) {
    demand(!this.pieces.has(id), `prop ${id} comes a second time`);
    this.pieces.set(id, { prop, position: [x, y, z], rotation });
  }

  piece({ id, volume, x, y, z, rotation }) {
    demand(!this.pieces.has(id), `piece ${id} comes a second time`);
    this.pieces.set(id, { volume: unpackVolume(volume), position: [x, y, z], rotation });
    this.counts.pieces++;
  }

  reset() {
    this.edits.clear();
    this.pieces.clear();
    this.mismatched = null;
    this.counts.resets++;
  }

  // ---- what there is

  chunkHash(key) {
    return this.edits.get(key)?.hash ?? 0n;
  }

  fieldHash() {
    let sum = 0n;
    for (const { hash } of this.edits.values()) sum += hash;
    return wrapped(sum);
  }

  /** Codes of a brick as it is now; null where neither edit nor ground is known. */
  codes(brick) {
    const key = keyOf(brick);
    return this.edits.get(keyOf(chunkOf(brick)))?.bricks.get(key)?.codes ?? this.ground.get(key) ?? null;
  }

  /**
   * Makes an edited brick wrong, in the chunk of a place (voxels) but away from it, so that the next check over the chunk
   * fails. Returns whether there was one.
   */
  spoil(place) {
    const key = keyOf(place.map((number) => Math.floor(number / 32)));
    for (const brick of this.edits.get(key)?.bricks.values() ?? []) {
      const off = Math.hypot(...brick.coord.map((number, axis) => 8 * number + 4 - place[axis]));
      if (off < 24) continue;
      this.edit(key, { ...brick, codes: brick.codes.map((code) => -code) });
      return true;
    }
    return false;
  }

  edit(key, { coord, codes, materials }) {
    if (!this.edits.has(key)) this.edits.set(key, { hash: 0n, bricks: new Map() });
    const chunk = this.edits.get(key);
    const hash = brickHash(coord, codes, materials);
    const before = chunk.bricks.get(keyOf(coord))?.hash ?? 0n;
    chunk.bricks.set(keyOf(coord), { coord, codes, materials, hash });
    chunk.hash = wrapped(chunk.hash + hash - before);
  }
}
