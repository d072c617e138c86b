// A small curve of the last values, in SVG.
import { make, write } from './dom.js';

const SPACE = 'http://www.w3.org/2000/svg';
const KEPT = 120;

/** The points of a polyline, for a box of that size; the last value is at its right end. */
export function points(values, width, height, kept = KEPT) {
  const most = Math.max(...values, Number.MIN_VALUE);
  const first = kept - values.length;
  return values.map((value, i) =>
    `${((first + i) * width / (kept - 1)).toFixed(1)},${(height - 1 - (height - 2) * value / most).toFixed(1)}`).join(' ');
}

export class Spark {
  #values = [];
  #line = document.createElementNS(SPACE, 'polyline');
  #area = document.createElementNS(SPACE, 'polygon');
  #now = make('b');
  #most = make('span');

  constructor(title) {
    const svg = document.createElementNS(SPACE, 'svg');
    svg.setAttribute('viewBox', '0 0 240 40');
    svg.setAttribute('preserveAspectRatio', 'none');
    svg.setAttribute('aria-hidden', 'true');
    svg.append(this.#area, this.#line);
    this.element = make('figure', { className: 'spark' }, make('figcaption', {}, make('span', {}, title), this.#now, this.#most), svg);
  }

  add(value) {
    if (!Number.isFinite(value)) return;
    this.#values.push(value);
    if (this.#values.length > KEPT) this.#values.shift();
  }

  draw(say = (value) => (value < 10 ? value.toFixed(2) : String(Math.round(value)))) {
    if (this.#values.length === 0) return;
    const line = points(this.#values, 240, 40);
    this.#line.setAttribute('points', line);
    this.#area.setAttribute('points', `${((KEPT - this.#values.length) * 240 / (KEPT - 1)).toFixed(1)},40 ${line} 240,40`);
    write(this.#now, say(this.#values.at(-1)));
    write(this.#most, `most ${say(Math.max(...this.#values))}`);
  }
}
