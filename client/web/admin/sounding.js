// Asks the server how high the ground is, by rays straight down, 64 a message, within its limits: questions are about what lies
// near the eye, so the eye of the connection goes from zone to zone, and looks at nothing (Interest) when there is nothing to ask.
import { ROCK, VOID } from './tiles.js';

/** Questions of a message, and of all that wait at once: under the server's 64 and 512, of which each message counts as one. */
const AT_ONCE = 64, WAITING_MAX = 400;
/** Questions a second, and saved up: under the server's 1,000 and 2,000. */
const PER_SECOND = 900, SAVED_UP = 1500;
/** A zone's side, how far rays go up and down from its middle, and the radius of interest: the corners lie within 1.25 times of it. */
const ZONE_M = 256, RAY_M = 500, RADIUS_M = 256;
/** Bands of heights that are tried: the middle one, then the one above where a ray starts in rock, or below where it hits nothing. */
const BAND_M = 480;
const AGAIN_MS = 400;
const HALF_WIDTH_M = 4096;

const DOWN = { x: 0, y: -1, z: 0 };

export class Sounding {
  #session;
  #changed;
  #middle_y;
  #zone = '';
  #waiting = 0;
  #credit = SAVED_UP;
  #at_ms = performance.now();
  #pause_until_ms = 0;
  #looking = false;
  #bands = new WeakMap();  // by tile: Map of sample → band

  /** `changed(tile)`: samples came. */
  constructor(session, changed) {
    this.#session = session;
    this.#changed = changed;
  }

  /** Of a new connection: the ground's middle height, as far as it is known. */
  restart(middle_y) {
    this.#middle_y = middle_y;
    this.#zone = '';
    this.#waiting = 0;
    this.#looking = false;
    this.#pause_until_ms = 0;
  }

  get busy() { return this.#waiting > 0; }

  /** Asks for what these tiles lack, the first ones first; call it often. True: something is missing still. */
  step(tiles) {
    const now_ms = performance.now();
    this.#credit = Math.min(this.#credit + PER_SECOND * (now_ms - this.#at_ms) / 1000, SAVED_UP);
    this.#at_ms = now_ms;
    if (this.#session.phase !== 'joined' || now_ms < this.#pause_until_ms) return true;
    for (;;) {
      const next = this.#next(tiles);
      if (!next) break;
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

  #zone_of({ x, z }, band) {
    const zx = Math.floor(x / ZONE_M), zz = Math.floor(z / ZONE_M);
    return { key: `${zx}/${zz}/${band}`, eye: { x: (zx + 0.5) * ZONE_M, y: this.#middle_y + band * BAND_M, z: (zz + 0.5) * ZONE_M }, band };
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
      const here = groups.get(this.#zone);
      if (here) return here;
      first ??= groups.values().next().value;
    }
    return first;
  }

  #groups(tile) {
    const groups = new Map(), bands = this.#bands.get(tile);
    for (const index of tile.left) {
      if (tile.asked.has(index)) continue;
      const zone = this.#zone_of(tile.place(index), bands?.get(index) ?? 0);
      const group = groups.get(zone.key) ?? { tile, zone, samples: [] };
      groups.set(zone.key, group);
      if (group.samples.length < AT_ONCE) group.samples.push(index);
    }
    return groups;
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
    const from_y = zone.eye.y + RAY_M / 2;
    const questions = samples.map((index) => {
      const { x, z } = tile.place(index);
      return { mask: { noPieces: true, noProps: true }, kind: { case: 'ray', value: { from: { x, y: from_y, z }, direction: DOWN, mostM: RAY_M } } };
    });
    for (const index of samples) tile.asked.add(index);
    this.#waiting += samples.length + 1;
    this.#credit -= samples.length;
    const { round } = tile;
    try {
      const answer = await this.#session.query(questions);
      if (tile.round !== round);
      else if (answer.refusal.length) this.#again(tile, samples);
      else answer.answers.forEach((one, i) => this.#take(tile, samples[i], zone.band, one));
    } catch {
      if (tile.round === round) this.#again(tile, samples);
    }
    this.#waiting = Math.max(this.#waiting - samples.length - 1, 0);
    this.#changed(tile);
  }

  #again(tile, samples) {
    for (const index of samples) tile.asked.delete(index);
    this.#pause_until_ms = performance.now() + AGAIN_MS;
  }

  #take(tile, index, band, { kind, refusal }) {
    const { x, z } = tile.place(index);
    if (kind.case === 'hit' && !kind.value.inside) return tile.set(index, ROCK, kind.value.place?.y ?? 0, kind.value.material);
    const next = kind.case === 'hit' ? band + 1 : kind.case === 'nothing' ? band - 1 : band;
    if (next === band && Math.max(Math.abs(x), Math.abs(z)) < HALF_WIDTH_M && refusal.length) return this.#again(tile, [index]);
    if (next === band || Math.abs(next) > 1 || Math.sign(next) === -Math.sign(band)) return tile.set(index, VOID);
    const bands = this.#bands.get(tile) ?? new Map();
    this.#bands.set(tile, bands.set(index, next));
    tile.asked.delete(index);
  }
}
