// Asks the server how high the ground is, by rays straight down, 64 a message, within its limits. Questions are about what lies
// near the eye, so the eye of the connection goes from zone to zone, and looks at nothing (Interest) when there is nothing to ask.
//
// What the server works for a ray is the air above the ground, which it makes chunk by chunk. So a ray begins a little above the
// height that is known nearby, and again from higher where that was within rock.
import { ROCK, VOID, spacing_of } from './tiles.js';

/** Questions of a message, and of all that wait at once: under the server's 64 and 512, and few, so that a map that moved need not wait long. */
const AT_ONCE = 64, WAITING_MAX = 260;
/** Questions a second, and saved up: under the server's 1,000 and 2,000. */
const PER_SECOND = 900, SAVED_UP = 1500;
/** A zone's side, how far its rays go up and down from its eye, and the radius of interest: all of it lies within 1.25 times of that. */
const ZONE_M = 256, UP_M = 255, RADIUS_M = 256;
/** Bands of heights that overlap: the one in the middle, and one above and below, where what is looked for is there. */
const BAND_M = 480;
/** How far above the ground nearby a ray begins, and by how much more for each metre to there; and how much higher it is tried again. */
const ABOVE_M = 6, ABOVE_EACH_M = 1.2, LIFTS_M = [0, 24, 96, 250, 500, 1000];
/** Above this no generated ground reaches. */
const GENERATED_TOP_M = 40;
const AGAIN_MS = 400;
const HALF_WIDTH_M = 4096;

const DOWN = { x: 0, y: -1, z: 0 };

export class Sounding {
  #session;
  #tiles;
  #changed;
  #middle_y = 0;
  #top_y = GENERATED_TOP_M;
  #zone = '';
  #waiting = 0;
  #credit = SAVED_UP;
  #at_ms = performance.now();
  #pause_until_ms = 0;
  #looking = false;
  #tries = new WeakMap();  // by tile: by sample: {lifts, band} of those that one ray did not find

  /** `changed()`: samples came. */
  constructor(session, tiles, changed) {
    this.#session = session;
    this.#tiles = tiles;
    this.#changed = changed;
  }

  /** Of a new connection; `heights`: those of its welcome. */
  restart(heights) {
    this.#middle_y = heights ? (heights.lowest + heights.highest) / 512 : 0;
    this.#top_y = heights ? heights.highest / 256 + ABOVE_M : GENERATED_TOP_M;
    this.#zone = '';
    this.#waiting = 0;
    this.#looking = false;
    this.#pause_until_ms = 0;
  }

  /** Asks for what these tiles lack, the first ones first; call it often. True: something is missing still. */
  step(tiles) {
    const now_ms = performance.now();
    this.#credit = Math.min(this.#credit + PER_SECOND * (now_ms - this.#at_ms) / 1000, SAVED_UP);
    this.#at_ms = now_ms;
    if (this.#session.phase !== 'joined' || now_ms < this.#pause_until_ms) return true;
    for (let next = this.#next(tiles); next; next = this.#next(tiles)) {
      if (this.#waiting + next.samples.length > WAITING_MAX || next.samples.length > this.#credit) return true;
      if (next.zone.key !== this.#zone) {
        if (this.#waiting > 0) return true;
        this.#look_at(next.zone);
      }
      this.#ask(next);
    }
    if (this.#waiting === 0 && this.#looking) this.#rest();
    return this.#waiting > 0;
  }

  /** Up to 64 samples of one tile that lie in one zone: of the coarsest pass that is missing, in the zone of before if there is one. */
  #next(tiles) {
    const wanted = tiles.filter((tile) => tile.left.size > tile.asked.size);
    if (wanted.length === 0) return null;
    const pass = Math.min(...wanted.map((tile) => tile.pass));
    let first = null;
    for (const tile of wanted) {
      if (tile.pass !== pass) continue;
      const groups = this.#groups(tile);
      if (groups.has(this.#zone)) return groups.get(this.#zone);
      first ??= groups.values().next().value;
    }
    return first;
  }

  #groups(tile) {
    const groups = new Map(), tries = this.#tries.get(tile);
    for (const index of tile.left) {
      if (tile.asked.has(index)) continue;
      const { lifts, band } = tries?.get(index) ?? { lifts: 0, band: 0 }, from_y = this.#start(tile, index) + LIFTS_M[lifts];
      const zone = this.#zone_of(tile.place(index), band === 0 && from_y > this.#middle_y + UP_M ? 1 : band);
      const group = groups.get(zone.key) ?? { tile, zone, samples: [] };
      groups.set(zone.key, group);
      if (group.samples.length < AT_ONCE) group.samples.push({ index, from_y: Math.min(from_y, zone.eye.y + UP_M) });
    }
    return groups;
  }

  #zone_of({ x, z }, band) {
    const zx = Math.floor(x / ZONE_M), zz = Math.floor(z / ZONE_M);
    return { key: `${zx}/${zz}/${band}`, eye: { x: (zx + 0.5) * ZONE_M, y: this.#middle_y + band * BAND_M, z: (zz + 0.5) * ZONE_M }, band };
  }

  /** Where the ground nearby lets a ray begin. */
  #start(tile, index) {
    const known = tile.known(index), { x, z } = tile.place(index);
    if (known >= 0 && tile.states[known] === ROCK) {
      const other = tile.place(known);
      return tile.heights[known] + ABOVE_M + ABOVE_EACH_M * Math.hypot(other.x - x, other.z - z);
    }
    const near = this.#tiles.at(x, z);
    return near ? near.height + ABOVE_M + ABOVE_EACH_M * 4 * spacing_of(tile.level) : this.#top_y;
  }

  #look_at(zone) {
    this.#zone = zone.key;
    this.#looking = true;
    this.#session.tell('interest', { eye: zone.eye, radiusM: RADIUS_M });
  }

  #rest() {
    this.#zone = '';
    this.#looking = false;
    this.#session.tell('interest', { eye: {}, radiusM: 0 });
  }

  async #ask({ tile, zone, samples }) {
    const questions = samples.map(({ index, from_y }) => {
      const { x, z } = tile.place(index);
      return { mask: { noPieces: true, noProps: true }, kind: { case: 'ray', value: { from: { x, y: from_y, z }, direction: DOWN, mostM: from_y - zone.eye.y + UP_M } } };
    });
    for (const { index } of samples) tile.asked.add(index);
    this.#waiting += samples.length + 1;
    this.#credit -= samples.length;
    const answer = await this.#session.query(questions).catch(() => null);
    if (answer === null || answer.refusal.length) this.#again(tile, samples);
    else answer.answers.forEach((one, i) => this.#take(tile, samples[i], zone.band, one));
    this.#waiting = Math.max(this.#waiting - samples.length - 1, 0);
    this.#changed();
  }

  #again(tile, samples) {
    for (const { index } of samples) tile.asked.delete(index);
    this.#pause_until_ms = performance.now() + AGAIN_MS;
  }

  #take(tile, sample, band, { kind }) {
    const { index } = sample, { x, z } = tile.place(index), refused = kind.case === 'refusal';
    if (kind.case === 'hit' && !kind.value.inside) return tile.set(index, ROCK, kind.value.place?.y ?? 0, kind.value.material);
    if (refused && Math.max(Math.abs(x), Math.abs(z)) < HALF_WIDTH_M) return this.#again(tile, [sample]);
    const tries = this.#tries.get(tile) ?? new Map(), before = tries.get(index) ?? { lifts: 0, band: 0 };
    const inside = kind.case === 'hit', next = inside ? { lifts: before.lifts + 1, band: 0 } : { lifts: before.lifts, band: band - 1 };
    if (refused || (inside ? next.lifts >= LIFTS_M.length || before.band < 0 : next.band < -1)) {
      tries.delete(index);
      return tile.set(index, VOID);
    }
    this.#tries.set(tile, tries.set(index, next));
    tile.asked.delete(index);
  }
}
