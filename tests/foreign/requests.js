// Carves, and beside them paints and fills, one after the other at a rate; counts the replies.
const SPHERE = 0;
const BOX = 1;
const RADIAL = 1;
const MATERIALS = [1, 2]; // rows of the palette
const asPoint = ([x, y, z]) => ({ x, y, z });

/** Numbers in [0, 1) from a seed (mulberry32). */
function randomFrom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

export class Requests {
  counts = { carves: 0, paints: 0, fills: 0, accepted: 0, refused: 0, last_refusal: '' };

  /**
   * `place(random)`: where to carve, in metres, or null to try later. `onCarve(place, number)` is called before each, and
   * says whether the carve has to be right there, or may be about there.
   */
  constructor({ connection, count, rate, seed, place, onCarve }) {
    Object.assign(this, { connection, count, place, onCarve, random: randomFrom(seed) });
    this.sent = 0;
    this.timer = setInterval(() => this.next(), 1000 / rate);
  }

  stop() {
    clearInterval(this.timer);
  }

  done() {
    return this.counts.carves === this.count && this.counts.accepted + this.counts.refused === this.sent;
  }

  next() {
    if (this.counts.carves === this.count) return this.stop();
    const place = this.place(this.random);
    if (place === null) return;
    this.carve(place);
    if (this.counts.carves % 5 === 0) this.paint(place);
    if (this.counts.carves % 10 === 0) this.fill(place);
  }

  carve(place) {
    const spread = this.onCarve(place, this.counts.carves) ? 0 : 3;
    const radius = 1 + 0.6 * this.random();
    const middle = place.map((number) => number + spread * (this.random() - 0.5));
    this.send('carve', {
      shape: { kind: SPHERE, a: asPoint(middle), radius_m: radius },
      pattern: RADIAL,
      seeds: 6 + Math.floor(6 * this.random()),
      random_seed: Math.floor(4294967296 * this.random()),
      impact: asPoint(middle),
      blast_speed_m_s: 3,
    });
    this.counts.carves++;
  }

  paint(place) {
    const material = MATERIALS[Math.floor(MATERIALS.length * this.random())];
    this.send('paint', { shape: { kind: BOX, a: asPoint(place), b: asPoint([2, 2, 2]) }, material });
    this.counts.paints++;
  }

  fill(place) {
    this.send('fill', { shape: { kind: SPHERE, a: asPoint(place), radius_m: 1 } });
    this.counts.fills++;
  }

  send(kind, content) {
    this.connection.send(kind, { ...content, request: ++this.sent });
  }

  answered({ refusal }) {
    if (refusal.length === 0) return void this.counts.accepted++;
    this.counts.refused++;
    this.counts.last_refusal = Buffer.from(refusal).toString();
  }
}
