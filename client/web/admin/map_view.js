// The map: a top view of the world on a canvas, x to the right and z down, that is moved by mouse, fingers and keys. A click or
// Enter chooses a place; Shift and a drag, or the button for boxes and a drag, or B and Enter, choose a box.
import { make, write } from '../page/dom.js';
import { Painter } from './paint.js';
import { LEVELS, level_for, tile_m } from './tiles.js';

const PER_PIXEL_MIN = 0.03, PER_PIXEL_MAX = 5, ZOOM = 1.25;
const HALF_WIDTH_M = 4096;
const CLICK_PIXELS = 5;
const INK = { region: '#7fd0ff', edit: '#ffd27a', preview: '#ff7a66', chosen: '#ffffff', cross: 'rgb(255 255 255 / 75%)' };

const round = (metres) => (Math.round(10 * metres) / 10).toFixed(1);

/** A round length that a scale bar of at most so many pixels stands for. */
export function scale_of(metres_per_pixel, most_pixels) {
  const most = metres_per_pixel * most_pixels, power = 10 ** Math.floor(Math.log10(most));
  const metres = [5, 2, 1].map((one) => one * power).find((one) => one <= most);
  return { metres, pixels: metres / metres_per_pixel, text: metres >= 1000 ? `${metres / 1000} km` : `${metres} m` };
}

export class MapView {
  element = make('div', { className: 'map' });
  canvas = make('canvas', { tabIndex: 0 });
  /** Choosing a box, by the button. */
  boxing = false;
  #centre = { x: 0, z: 0 };
  #per_pixel = 0.5;
  #wanted_m = 0;     // what is to be seen around the middle once the map has a size
  #hovers = false;
  #tiles;
  #painter;
  #on;
  #pointers = new Map();
  #drag = null;      // {x, z, px, py, box, moved}: where it began
  #pinch = null;
  #corner = null;    // of a box that the keys began
  #marks = { regions: [], edits: [], previews: [], chosen: null, lit: null };
  #drawing = false;
  #readout = make('p', { className: 'readout' });
  #scale = make('div', { className: 'scale', aria: { hidden: 'true' } });
  #names = [];

  /** `on`: {place({x, z}), box({lo, hi})}. */
  constructor(tiles, on) {
    this.#tiles = tiles;
    this.#painter = new Painter(tiles);
    this.#on = on;
    this.canvas.setAttribute('role', 'application');
    this.canvas.setAttribute('aria-label', 'Map of the world from above. Arrow keys move, plus and minus zoom, Enter chooses the place in the middle, B begins a box and Enter ends it, Escape forgets it.');
    this.element.append(this.canvas, this.#readout, this.#scale);
    new ResizeObserver(() => (this.#wanted_m > 0 ? this.go(this.#centre, this.#wanted_m) : this.draw())).observe(this.element);
    this.#listen();
  }

  #listen() {
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => this.#down(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (event) => this.#up(event));
    canvas.addEventListener('pointerleave', () => {
      this.#hovers = false;
      this.draw();
    });
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(ZOOM ** -Math.sign(event.deltaY), event.offsetX, event.offsetY);
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => this.#key(event));
    for (const change of ['focus', 'blur']) canvas.addEventListener(change, () => this.draw());
  }

  // ---- where it looks

  get size() { return { width: this.element.clientWidth, height: this.element.clientHeight }; }
  get level() { return level_for(this.#per_pixel); }
  get centre() { return { ...this.#centre }; }
  get per_pixel() { return this.#per_pixel; }

  /** The box of the world that is seen. */
  get seen() {
    const { width, height } = this.size, x = this.#per_pixel * width / 2, z = this.#per_pixel * height / 2;
    return { lo: { x: this.#centre.x - x, z: this.#centre.z - z }, hi: { x: this.#centre.x + x, z: this.#centre.z + z } };
  }

  #world(px, py) {
    const { width, height } = this.size;
    return { x: this.#centre.x + (px - width / 2) * this.#per_pixel, z: this.#centre.z + (py - height / 2) * this.#per_pixel };
  }

  #pixel({ x, z }) {
    const { width, height } = this.size;
    return [(x - this.#centre.x) / this.#per_pixel + width / 2, (z - this.#centre.z) / this.#per_pixel + height / 2];
  }

  go({ x, z }, radius_m = 0) {
    const within = (value) => Math.min(Math.max(value, -HALF_WIDTH_M), HALF_WIDTH_M);
    this.#centre = { x: within(x), z: within(z) };
    const { width, height } = this.size;
    this.#wanted_m = width === 0 ? radius_m : 0;
    if (radius_m > 0 && width > 0) this.#per_pixel = Math.min(Math.max(3 * radius_m / Math.min(width, height), 0.06), PER_PIXEL_MAX);
    this.#moved();
  }

  /** About a point of the canvas that stays; without one, its middle. */
  zoom(times, px = this.size.width / 2, py = this.size.height / 2) {
    const before = this.#world(px, py);
    this.#per_pixel = Math.min(Math.max(this.#per_pixel / times, PER_PIXEL_MIN), PER_PIXEL_MAX);
    const after = this.#world(px, py);
    this.go({ x: this.#centre.x + before.x - after.x, z: this.#centre.z + before.z - after.z });
  }

  #pan(right, down) {
    this.go({ x: this.#centre.x + right * this.#per_pixel, z: this.#centre.z + down * this.#per_pixel });
  }

  #moved() {
    this.draw();
  }

  // ---- what is marked

  colours(rows) {
    this.#names = rows.map(({ name }) => name);
    this.#painter.colours(rows);
    this.draw();
  }

  /** Boxes as {lo, hi}: `regions` with their `name` and `round`, `edits` of the history, `previews` of an undo; the `chosen` box or place; `lit`: the row that is pointed at. */
  mark(marks) {
    Object.assign(this.#marks, marks);
    this.draw();
  }

  #read(place) {
    const known = this.#tiles.at(place.x, place.z);
    write(this.#readout, `x ${round(place.x)}  z ${round(place.z)}${known ? `  y ${round(known.height)}  ${this.#names[known.material] ?? ''}` : ''}`);
  }

  // ---- pointers

  #down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.#pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (this.#pointers.size === 2) {
      this.#drag = null;
      this.#pinch = this.#span();
      return;
    }
    const place = this.#world(event.offsetX, event.offsetY);
    this.#drag = { ...place, px: event.offsetX, py: event.offsetY, box: event.shiftKey || this.boxing, moved: false };
  }

  #span() {
    const [a, b] = [...this.#pointers.values()];
    return { length: Math.max(Math.hypot(a.x - b.x, a.y - b.y), 1), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
  }

  #move(event) {
    const pointer = this.#pointers.get(event.pointerId);
    const place = this.#world(event.offsetX, event.offsetY);
    this.#hovers = event.pointerType === 'mouse';
    if (!pointer) return this.#read(place);
    const before = { ...pointer };
    Object.assign(pointer, { x: event.offsetX, y: event.offsetY });
    if (this.#pinch && this.#pointers.size === 2) {
      const now = this.#span();
      this.#pan(this.#pinch.x - now.x, this.#pinch.y - now.y);
      this.zoom(now.length / this.#pinch.length, now.x, now.y);
      this.#pinch = now;
      return;
    }
    if (!this.#drag) return;
    if (Math.hypot(event.offsetX - this.#drag.px, event.offsetY - this.#drag.py) > CLICK_PIXELS) this.#drag.moved = true;
    if (!this.#drag.moved) return;
    if (this.#drag.box) {
      this.#marks.growing = this.#box(this.#drag, place);
      this.#read(place);
      this.draw();
    } else {
      this.#pan(before.x - event.offsetX, before.y - event.offsetY);
    }
  }

  #box(a, b) {
    return { lo: { x: Math.min(a.x, b.x), z: Math.min(a.z, b.z) }, hi: { x: Math.max(a.x, b.x), z: Math.max(a.z, b.z) } };
  }

  #up(event) {
    const drag = this.#drag;
    this.#pointers.delete(event.pointerId);
    if (this.#pointers.size < 2) this.#pinch = null;
    if (this.#pointers.size > 0) return;
    this.#drag = null;
    this.#marks.growing = null;
    if (!drag || event.type === 'pointercancel') return this.draw();
    const place = this.#world(event.offsetX, event.offsetY);
    if (drag.box && drag.moved) this.#on.box(this.#box(drag, place));
    else if (!drag.moved) this.#on.place(place);
  }

  // ---- keys

  #key(event) {
    const step = event.shiftKey ? 200 : 50;
    const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (moves) this.#pan(...moves);
    else if (event.key === '+' || event.key === '=') this.zoom(ZOOM);
    else if (event.key === '-') this.zoom(1 / ZOOM);
    else if (event.key === 'b' || event.key === 'B') this.#corner = this.centre;
    else if (event.key === 'Enter') this.#choose();
    else if (event.key === 'Escape' && this.#corner) this.#corner = null;
    else if (event.key === 'Escape') this.#on.place(null);
    else return;
    event.preventDefault();
    this.#marks.growing = this.#corner ? this.#box(this.#corner, this.#centre) : null;
    this.draw();
  }

  #choose() {
    const corner = this.#corner;
    this.#corner = null;
    if (corner) this.#on.box(this.#box(corner, this.#centre));
    else this.#on.place(this.centre);
  }

  // ---- drawing

  draw() {
    if (this.#drawing) return;
    this.#drawing = true;
    requestAnimationFrame(() => {
      this.#drawing = false;
      const { width, height } = this.size;
      if (width > 0 && height > 0) this.#draw(width, height);
    });
  }

  #draw(width, height) {
    const ratio = Math.min(devicePixelRatio || 1, 2), { canvas } = this;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    const context = canvas.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = '#1c222a';
    context.fillRect(0, 0, width, height);
    this.#painter.begin_frame();
    for (let level = LEVELS - 1; level >= this.level; --level) this.#draw_level(context, level);
    this.#draw_marks(context);
    if (document.activeElement === canvas && this.#pointers.size === 0) this.#draw_cross(context, width / 2, height / 2);
    if (this.#painter.late) this.draw();
    if (!this.#hovers) this.#read(this.#centre);
    const { pixels, text } = scale_of(this.#per_pixel, Math.min(160, width / 3));
    this.#scale.style.width = `${pixels}px`;
    write(this.#scale, text);
  }

  /** Levels that are coarser lie below, so that what is not known yet is not empty. */
  #draw_level(context, level) {
    const side = tile_m(level) / this.#per_pixel;
    for (const tile of this.#tiles.within(level, this.seen)) {
      const picture = this.#painter.picture(tile);
      if (!picture) continue;
      const [x, y] = this.#pixel(tile.lo_m);
      // Whole pixels, so that no seam is between tiles.
      const left = Math.round(x), top = Math.round(y);
      context.drawImage(picture, left, top, Math.round(x + side) - left, Math.round(y + side) - top);
    }
  }

  #outline(context, { lo, hi, round: is_round }, ink, { fill = '', width = 1.5, dash = [] } = {}) {
    const [x0, y0] = this.#pixel(lo), [x1, y1] = this.#pixel(hi);
    context.beginPath();
    if (is_round) context.ellipse((x0 + x1) / 2, (y0 + y1) / 2, Math.abs(x1 - x0) / 2, Math.abs(y1 - y0) / 2, 0, 0, 2 * Math.PI);
    else context.rect(x0, y0, Math.max(x1 - x0, 3), Math.max(y1 - y0, 3));
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    context.setLineDash(dash);
    context.lineWidth = width + 2;
    context.strokeStyle = 'rgb(0 0 0 / 55%)';
    context.stroke();
    context.lineWidth = width;
    context.strokeStyle = ink;
    context.stroke();
    context.setLineDash([]);
  }

  #draw_marks(context) {
    const { regions, edits, previews, chosen, growing, lit } = this.#marks;
    for (const region of regions) {
      this.#outline(context, region, INK.region, { dash: [6, 4] });
      const [x, y] = this.#pixel({ x: (region.lo.x + region.hi.x) / 2, z: region.lo.z });
      this.#label(context, region.name, x, y - 6, INK.region);
    }
    for (const edit of edits) this.#outline(context, edit, INK.edit, { fill: 'rgb(255 210 122 / 12%)' });
    for (const preview of previews) this.#outline(context, preview, INK.preview, { fill: 'rgb(255 122 102 / 30%)', width: 2 });
    if (lit) this.#outline(context, lit, '#fff3d6', { fill: 'rgb(255 243 214 / 35%)', width: 3 });
    for (const box of [chosen, growing]) if (box) this.#outline(context, box, INK.chosen, { width: 2, dash: box === growing ? [4, 4] : [] });
  }

  #label(context, text, x, y, ink) {
    context.font = '600 13px system-ui, "DejaVu Sans", sans-serif';
    context.textAlign = 'center';
    context.lineWidth = 3;
    context.strokeStyle = 'rgb(0 0 0 / 75%)';
    context.strokeText(text, x, y);
    context.fillStyle = ink;
    context.fillText(text, x, y);
  }

  #draw_cross(context, x, y) {
    context.lineWidth = 1.5;
    context.strokeStyle = INK.cross;
    context.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + 4 * dx, y + 4 * dy);
      context.lineTo(x + 14 * dx, y + 14 * dy);
    }
    context.stroke();
  }
}
