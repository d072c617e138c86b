// Tiles as pictures: a sample's material gives the colour, and the slope there the light, which comes from the north-west. Between
// samples both are mixed, also with those of the tiles beside, so that no seam is seen.
import { ROCK, SIDE, UNKNOWN, spacing_of } from './tiles.js';

const LIGHT = { x: -0.5, y: 0.74, z: -0.45 };
const EMPTY = [28, 34, 42];
/** Pixels of a picture for each sample and way. */
const FINER = 4;
const WITH_EDGE = SIDE + 2;
const PICTURES_MAX = 600;
/** Milliseconds of a frame in which tiles are painted; the others keep their pictures until the next frame. */
const PAINT_MS = 14;

/** A colour for a material of which no palette says any. */
export function colour_of_row(row) {
  const hue = (row * 137.508) % 360, chroma = 46;
  const part = (offset) => { const k = (offset + hue / 30) % 12; return 128 - chroma * Math.max(-1, Math.min(k - 3, 9 - k, 1)); };
  return [part(0), part(8), part(4)];
}

/** How light a slope is, 0.35 to about 1.25: heights to the west, east, north and south of it, so far from each other. */
export function light_of(west, east, north, south, across_m) {
  const x = (west - east) / across_m, z = (north - south) / across_m;
  return 0.35 + 0.9 * Math.max((x * LIGHT.x + LIGHT.y + z * LIGHT.z) / Math.hypot(x, 1, z), 0);
}

export class Painter {
  #tiles;
  #pictures = new Map();  // by tile's key: {canvas, seen}
  #colours = [];
  #end_ms = 0;
  #samples = new Float32Array(4 * WITH_EDGE * WITH_EDGE);  // red, green, blue, and whether it is known, of a tile with its edge
  /** Whether a picture was left as it was for lack of time. */
  late = false;

  constructor(tiles) { this.#tiles = tiles; }

  /** The palette's rows, {name, colour}. */
  colours(rows) {
    this.#colours = rows.map(({ colour }, row) => colour ?? colour_of_row(row));
    this.#pictures.clear();
  }

  begin_frame() {
    this.#end_ms = performance.now() + PAINT_MS;
    this.late = false;
  }

  /** The tile's picture; null while nothing is known of it. */
  picture(tile) {
    const seen = this.#seen(tile), kept = this.#pictures.get(tile.key);
    if (kept?.seen === seen || tile.version === 0) return kept?.canvas ?? null;
    if (performance.now() > this.#end_ms) {
      this.late = true;
      return kept?.canvas ?? null;
    }
    const canvas = kept?.canvas ?? new OffscreenCanvas(SIDE * FINER, SIDE * FINER);
    this.#pictures.delete(tile.key);
    this.#pictures.set(tile.key, { canvas, seen });
    if (this.#pictures.size > PICTURES_MAX) this.#pictures.delete(this.#pictures.keys().next().value);
    this.#take_samples(tile);
    this.#paint(canvas.getContext('2d'));
    return canvas;
  }

  /** Changes of the tile, and of those around it, of which its own edges are mixed. */
  #seen({ level, x, z }) {
    let sum = 0;
    for (let j = -1; j <= 1; ++j) for (let i = -1; i <= 1; ++i) sum += this.#tiles.get(level, x + i, z + j)?.version ?? 0;
    return sum;
  }

  #take_samples(tile) {
    const step = spacing_of(tile.level), reach = tile.complete || tile.round > 0 ? 1 : tile.stride;
    for (let j = -1; j <= SIDE; ++j)
      for (let i = -1; i <= SIDE; ++i) {
        const own = this.#tiles.sample(tile.level, tile.x * SIDE + i, tile.z * SIDE + j), at = 4 * ((j + 1) * WITH_EDGE + i + 1);
        let colour = EMPTY, light = 1;
        if (own.state === ROCK) {
          colour = this.#colours[own.material] ?? colour_of_row(own.material);
          const height = (di, dj) => { const other = this.#tiles.sample(tile.level, tile.x * SIDE + i + di * reach, tile.z * SIDE + j + dj * reach); return other.state === ROCK ? other.height : own.height; };
          light = light_of(height(-1, 0), height(1, 0), height(0, -1), height(0, 1), 2 * reach * step);
        }
        for (let c = 0; c < 3; ++c) this.#samples[at + c] = colour[c] * light;
        this.#samples[at + 3] = own.state === UNKNOWN ? 0 : 1;
      }
  }

  /** Each pixel mixes the four samples around it, as far as they are known. */
  #paint(context) {
    const side = SIDE * FINER, image = context.createImageData(side, side), samples = this.#samples;
    for (let py = 0; py < side; ++py) {
      const y = (py + 0.5) / FINER + 0.5, j = Math.floor(y), v = y - j;
      for (let px = 0; px < side; ++px) {
        const x = (px + 0.5) / FINER + 0.5, i = Math.floor(x), u = x - i, first = 4 * (j * WITH_EDGE + i), below = first + 4 * WITH_EDGE;
        const a = (1 - u) * (1 - v) * samples[first + 3], b = u * (1 - v) * samples[first + 7], c = (1 - u) * v * samples[below + 3], d = u * v * samples[below + 7];
        const known = a + b + c + d;
        if (known === 0) continue;
        const at = 4 * (py * side + px);
        for (let k = 0; k < 3; ++k) image.data[at + k] = (a * samples[first + k] + b * samples[first + 4 + k] + c * samples[below + k] + d * samples[below + 4 + k]) / known;
        image.data[at + 3] = 255;
      }
    }
    context.putImageData(image, 0, 0);
  }
}
