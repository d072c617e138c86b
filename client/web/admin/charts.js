// Curves of the last hour, or since the server's start, with one axis of time: a pointer, or the arrow keys, read all of them at one moment.
import { make, write } from '../page/dom.js';

const SPACE = 'http://www.w3.org/2000/svg';
const WIDTH = 360, HEIGHT = 72, MARGIN = 3;
const HOUR_MS = 3600000, SPAN_MIN_MS = 300000;

function drawn(tag, attributes) {
  const element = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}

/** A round number that is at least that large: 1, 2 or 5 times a power of ten. */
export function round_above(value) {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((one) => one * power).find((one) => one >= value * (1 - 1e-9));
}

/** "M" and "L" of a path through the samples that have the number; a gap longer than `gap_ms` breaks it. */
export function path_of(samples, number, { first_ms, span_ms }, most, gap_ms = 25000) {
  let path = '', before = -Infinity;
  for (const sample of samples) {
    const value = number(sample);
    if (!Number.isFinite(value)) continue;
    const x = WIDTH * (sample.at_ms - first_ms) / span_ms, y = HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN) * Math.min(value / most, 1);
    path += `${sample.at_ms - before > gap_ms ? 'M' : 'L'}${x.toFixed(1)},${y.toFixed(1)}`;
    before = sample.at_ms;
  }
  return path;
}

class Chart {
  #lines = [];
  #kind;
  #now = make('b');
  #top = make('span', { className: 'top', aria: { hidden: 'true' } });
  #hand = drawn('line', { y1: 0, y2: HEIGHT, class: 'hand', visibility: 'hidden' });
  #limit = drawn('line', { x1: 0, x2: WIDTH, class: 'limit', visibility: 'hidden' });

  constructor(kind) {
    this.#kind = kind;
    const svg = drawn('svg', { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: 'none', 'aria-hidden': 'true' });
    for (let i = 1; i < 4; ++i) svg.append(drawn('line', { x1: WIDTH * i / 4, x2: WIDTH * i / 4, y1: 0, y2: HEIGHT, class: 'grid' }));
    svg.append(this.#limit);
    this.#lines = kind.curves.map((_, i) => svg.appendChild(drawn('path', { class: `curve c${i}` })));
    svg.append(this.#hand);
    const keys = kind.curves.length > 1 ? kind.curves.map(({ name }, i) => make('i', { className: `key c${i}` }, name)) : [];
    this.element = make('figure', { className: 'chart box' }, make('figcaption', {}, make('h3', {}, kind.title), ...keys, this.#now), make('div', { className: 'plot' }, svg, this.#top));
  }

  draw(samples, axis) {
    const all = this.#kind.curves.flatMap(({ number }) => samples.map(number).filter(Number.isFinite));
    const limit = this.#kind.limit?.();
    const most = round_above(Math.max(...all, this.#kind.least ?? 0, limit !== undefined && Math.max(...all) > limit / 4 ? limit : 0));
    this.#kind.curves.forEach(({ number }, i) => this.#lines[i].setAttribute('d', path_of(samples, number, axis, most)));
    write(this.#top, this.#kind.say(most));
    const shows = limit !== undefined && limit < most;
    const y = HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN) * Math.min((limit ?? 0) / most, 1);
    this.#limit.setAttribute('visibility', shows ? 'visible' : 'hidden');
    for (const end of ['y1', 'y2']) this.#limit.setAttribute(end, y);
  }

  /** Reads it at that sample; `hand`: shows where that is. */
  read(sample, { first_ms, span_ms }, hand) {
    write(this.#now, sample ? this.#kind.curves.map(({ number }) => (Number.isFinite(number(sample)) ? this.#kind.say(number(sample)) : '–')).join(' / ') : '–');
    this.#hand.setAttribute('visibility', sample && hand ? 'visible' : 'hidden');
    if (!sample) return;
    const x = WIDTH * (sample.at_ms - first_ms) / span_ms;
    for (const end of ['x1', 'x2']) this.#hand.setAttribute(end, x);
  }
}

export class Charts {
  #charts;
  #samples = [];
  #axis = { first_ms: 0, span_ms: HOUR_MS };
  #read = null;  // the time that is read; null: the newest
  #moment = make('p', { className: 'dim moment' });

  /** `kinds`: {title, curves: [{name, number(sample)}], say(number), least, limit()}. Samples have `at_ms`. */
  constructor(kinds) {
    this.#charts = kinds.map((kind) => new Chart(kind));
    const grid = make('div', { className: 'charts', tabIndex: 0, role: 'group', aria: { label: 'Figures of the last hour; the arrow keys read them at another time' } }, ...this.#charts.map(({ element }) => element));
    grid.addEventListener('pointermove', (event) => this.#point(event));
    grid.addEventListener('pointerleave', () => this.#at(null));
    grid.addEventListener('keydown', (event) => this.#key(event));
    this.#moment.setAttribute('role', 'status');
    this.element = make('section', { className: 'hour' }, make('div', { className: 'row heading' }, make('h2', {}, 'The last hour'), this.#moment), grid);
  }

  show(samples, now_ms) {
    this.#samples = samples;
    const span_ms = Math.min(Math.max(now_ms - (samples[0]?.at_ms ?? now_ms), SPAN_MIN_MS), HOUR_MS);
    this.#axis = { first_ms: now_ms - span_ms, span_ms };
    for (const chart of this.#charts) chart.draw(samples, this.#axis);
    this.#at(this.#read);
  }

  #at(time_ms) {
    this.#read = time_ms;
    const sample = time_ms === null ? this.#samples.at(-1)
      : this.#samples.reduce((best, one) => (!best || Math.abs(one.at_ms - time_ms) < Math.abs(best.at_ms - time_ms) ? one : best), null);
    for (const chart of this.#charts) chart.read(sample, this.#axis, time_ms !== null);
    const moment = !sample ? 'The server has no figures yet: one comes every 10 s.' : time_ms === null ? `now; the left edge is ${Math.round(this.#axis.span_ms / 60000)} min ago; point at a curve to read it there` : `at ${new Date(sample.at_ms).toLocaleTimeString()}`;
    write(this.#moment, moment);
  }

  #point(event) {
    const plot = event.target.closest('.plot')?.getBoundingClientRect();
    if (plot) this.#at(this.#axis.first_ms + this.#axis.span_ms * (event.clientX - plot.left) / plot.width);
  }

  #key(event) {
    const steps = { ArrowLeft: -1, ArrowRight: 1, PageUp: -30, PageDown: 30 }[event.key];
    if (event.key === 'Escape' || event.key === 'End') return this.#at(null);
    if (steps === undefined || this.#samples.length === 0) return;
    event.preventDefault();
    const at = this.#read === null ? this.#samples.length - 1 : this.#samples.findIndex(({ at_ms }) => at_ms >= this.#read);
    const next = Math.min(Math.max((at < 0 ? this.#samples.length - 1 : at) + steps, 0), this.#samples.length - 1);
    this.#at(this.#samples[next].at_ms);
  }
}
