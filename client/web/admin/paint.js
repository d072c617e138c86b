// Tiles as pictures: a sample's material gives the colour, and the slope there the light, which comes from the north-west.
import { SIDE, ROCK, VOID, spacing_of } from './tiles.js';

const LIGHT = { x: -0.5, y: 0.74, z: -0.45 };
const SKY = [28, 34, 42];

/** A colour for a material of which no palette says any. */
export function colour_of_row(row) {
  const hue = (row * 137.508) % 360, chroma = 46;
  const part = (offset) => { const k = (offset + hue / 30) % 12; return 128 - chroma * Math.max(-1, Math.min(k - 3, 9 - k, 1)); };
  return [part(0), part(8), part(4)];
}

/** How light a slope is, 0 to about 1.3: heights a step away to the west, east, north and south of it. */
export function light_of(west, east, north, south, across_m) {
  const x = (west - east) / across_m, z = (north - south) / across_m;
  const length = Math.hypot(x, 1, z);
  return 0.35 + 0.9 * Math.max((x * LIGHT.x + LIGHT.y + z * LIGHT.z) / length, 0);
}

export class Painter {
  #tiles;
  #pictures = new Map();  // by tile's key: {canvas, seen}
  #colours = [];

  constructor(tiles) { this.#tiles = tiles; }

  /** The palette's rows, {name, colour}. */
  colours(rows) {
    this.#colours = rows.map(({ colour }, row) => colour ?? colour_of_row(row));
    this.#pictures.clear();
  }

  /** The tile's picture, one pixel for each sample; null while nothing is known of it. */
  picture(tile) {
    const seen = this.#seen(tile);
    let kept = this.#pictures.get(tile.key);
    if (kept?.seen === seen) return kept.canvas;
    if (tile.version === 0) return null;
    kept ??= { canvas: new OffscreenCanvas(SIDE, SIDE) };
    kept.seen = seen;
    this.#pictures.set(tile.key, kept);
    if (this.#pictures.size > 2400) this.#pictures.delete(this.#pictures.keys().next().value);
    this.#paint(tile, kept.canvas.getContext('2d'));
    return kept.canvas;
  }

  /** Changes of the tile, and of those whose edges its own slopes need. */
  #seen({ level, x, z }) {
    let sum = 0;
    for (const [i, j] of [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]]) sum += this.#tiles.get(level, x + i, z + j)?.version ?? 0;
    return sum;
  }

  #paint(tile, context) {
    const image = context.createImageData(SIDE, SIDE);
    const step = spacing_of(tile.level), i0 = tile.x * SIDE, j0 = tile.z * SIDE;
    for (let index = 0; index < SIDE * SIDE; ++index) {
      const one = tile.known(index);
      if (one < 0) continue;
      const i = i0 + index % SIDE, j = j0 + Math.floor(index / SIDE), at = 4 * index;
      let colour = SKY, light = 1;
      if (tile.states[one] === ROCK) {
        colour = this.#colours[tile.materials[one]] ?? colour_of_row(tile.materials[one]);
        light = this.#light(tile, i, j, tile.heights[one], step);
      } else if (tile.states[one] !== VOID) continue;
      for (let c = 0; c < 3; ++c) image.data[at + c] = Math.min(colour[c] * light, 255);
      image.data[at + 3] = 255;
    }
    context.putImageData(image, 0, 0);
  }

  /** Slopes over as many samples as stand for one while the tile is coarse. */
  #light({ level, pass }, i, j, own, step) {
    const reach = pass >= 2 ? 1 : pass === 1 ? 2 : 4;
    const height = (di, dj) => this.#tiles.height(level, i + di * reach, j + dj * reach) ?? own;
    return light_of(height(-1, 0), height(1, 0), height(0, -1), height(0, 1), 2 * reach * step);
  }
}
