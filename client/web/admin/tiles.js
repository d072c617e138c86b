// The world from above as tiles of samples: how high the ground is, and what it is of. Without elements and without a connection.
//
// Level L has a sample each 2^L half metres; a tile has 32 × 32 of them. A tile is asked for in passes, each finer than the one
// before, so that a coarse picture is there first, and so that the height is known about where the next ones are asked for.

export const SIDE = 32, FINEST_M = 0.5, LEVELS = 7;
/** Distance between the samples of a pass, in samples. */
const STRIDES = [16, 4, 2, 1];
/** Levels from this one on have no last pass: each of their samples costs the server as much as many of a finer level do. */
const COARSE_LEVEL = 4;
export const UNKNOWN = 0, ROCK = 1, VOID = 2;

export const spacing_of = (level) => FINEST_M * 2 ** level;
export const tile_m = (level) => SIDE * spacing_of(level);

/** The level whose samples are about eight pixels apart. */
export const level_for = (metres_per_pixel) => Math.min(Math.max(Math.round(Math.log2(8 * metres_per_pixel / FINEST_M)), 0), LEVELS - 1);

const NOTHING = { state: UNKNOWN, height: 0, material: 0 };

/** Indices of the samples that a pass adds to those before. */
const NEW_IN = STRIDES.map((stride, pass) => Array.from({ length: SIDE * SIDE }, (_, i) => i).filter((i) => {
  const on = (step) => (i % SIDE) % step === 0 && Math.floor(i / SIDE) % step === 0;
  return on(stride) && (pass === 0 || !on(STRIDES[pass - 1]));
}));

export class Tile {
  heights = new Float32Array(SIDE * SIDE);
  materials = new Uint8Array(SIDE * SIDE);
  states = new Uint8Array(SIDE * SIDE);
  /** Grows with each change; who draws it compares. */
  version = 0;
  /** The pass that is asked for next; as many as there are: the tile is complete. */
  pass = 0;
  /** Samples of that pass that have no answer yet. */
  left = new Set(NEW_IN[0]);
  /** Those among them that are being asked for. */
  asked = new Set();
  /** How often all was asked for anew. */
  round = 0;
  used = 0;
  #stale = false;

  constructor(level, x, z) { Object.assign(this, { level, x, z, key: `${level}/${x}/${z}` }); }

  get passes() { return this.level < COARSE_LEVEL ? STRIDES.length : STRIDES.length - 1; }
  get complete() { return this.pass >= this.passes; }
  /** How far samples lie apart that are all there, in samples. */
  get stride() { return STRIDES[Math.max(this.pass - 1, 0)]; }

  get lo_m() { return { x: this.x * tile_m(this.level), z: this.z * tile_m(this.level) }; }

  place(index) {
    const step = spacing_of(this.level);
    return { x: this.lo_m.x + (index % SIDE + 0.5) * step, z: this.lo_m.z + (Math.floor(index / SIDE) + 0.5) * step };
  }

  set(index, state, height = 0, material = 0) {
    this.states[index] = state;
    this.heights[index] = height;
    this.materials[index] = material;
    this.asked.delete(index);
    this.left.delete(index);
    ++this.version;
    if (this.left.size > 0 || this.complete) return;
    ++this.pass;
    this.left = new Set(this.complete ? [] : NEW_IN[this.pass]);
    if (this.complete && this.#stale) this.renew();
  }

  /** All is asked for anew, as soon as it is complete; what is known stays until then. */
  renew() {
    this.#stale = !this.complete;
    if (this.#stale) return;
    this.pass = 0;
    this.left = new Set(NEW_IN[0]);
    this.asked.clear();
    ++this.round;
  }

  /** The sample, or the one of a coarser pass that stands for it; -1: nothing is known there. */
  known(index) {
    for (let pass = STRIDES.length - 1; pass >= 0; --pass) {
      const stride = STRIDES[pass];
      const i = index % SIDE, j = Math.floor(index / SIDE);
      const one = (j - j % stride) * SIDE + i - i % stride;
      if (this.states[one] !== UNKNOWN) return one;
    }
    return -1;
  }
}

/** The tiles that are kept. */
export class Tiles {
  #tiles = new Map();
  #uses = 0;
  static MOST = 1200;

  get(level, x, z) { return this.#tiles.get(`${level}/${x}/${z}`); }
  all() { return [...this.#tiles.values()]; }

  /** Tiles of a level that meet a box of the map, {lo: {x, z}, hi: {x, z}}; those that are missing are made if `make`. */
  within(level, { lo, hi }, make = false) {
    const side = tile_m(level), found = [];
    for (let z = Math.floor(lo.z / side); z * side < hi.z; ++z)
      for (let x = Math.floor(lo.x / side); x * side < hi.x; ++x) {
        let tile = this.get(level, x, z);
        if (!tile && make) this.#tiles.set(`${level}/${x}/${z}`, tile = new Tile(level, x, z));
        if (!tile) continue;
        tile.used = ++this.#uses;
        found.push(tile);
      }
    if (make) this.#forget();
    return found;
  }

  #forget() {
    if (this.#tiles.size <= Tiles.MOST) return;
    const oldest = this.all().sort((a, b) => a.used - b.used).slice(0, this.#tiles.size - Math.floor(Tiles.MOST * 0.9));
    for (const { key } of oldest) this.#tiles.delete(key);
  }

  /** What is known of a sample anywhere on a level, by its number from the origin: {state, height, material}. */
  sample(level, i, j) {
    const tile = this.get(level, Math.floor(i / SIDE), Math.floor(j / SIDE));
    const index = tile ? tile.known(((j % SIDE) + SIDE) % SIDE * SIDE + ((i % SIDE) + SIDE) % SIDE) : -1;
    return index < 0 ? NOTHING : { state: tile.states[index], height: tile.heights[index], material: tile.materials[index] };
  }

  /** The finest that is known of a place: {height, material}, or null. */
  at(x, z) {
    for (let level = 0; level < LEVELS; ++level) {
      const step = spacing_of(level), side = tile_m(level);
      const tile = this.get(level, Math.floor(x / side), Math.floor(z / side));
      if (!tile) continue;
      const index = tile.known(Math.floor((z - tile.lo_m.z) / step) * SIDE + Math.floor((x - tile.lo_m.x) / step));
      if (index >= 0 && tile.states[index] === ROCK) return { height: tile.heights[index], material: tile.materials[index] };
    }
    return null;
  }

  /** Asks anew for what lies in the box; without one, for everything. */
  renew(box = null) {
    for (const tile of this.all()) {
      const side = tile_m(tile.level), { lo_m } = tile;
      if (box && (lo_m.x > box.hi.x || lo_m.z > box.hi.z || lo_m.x + side < box.lo.x || lo_m.z + side < box.lo.z)) continue;
      tile.renew();
    }
  }
}
