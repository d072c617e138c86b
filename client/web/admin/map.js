// The part with the map: the world from above, who edited it where, and undo. Its questions about space need an eye in the world, so
// it has a connection of its own, which is there as long as the map is shown.
import { icon, make, write } from '../page/dom.js';
import { History } from './history.js';
import { MapView } from './map_view.js';
import { Session } from './session.js';
import { Sounding } from './sounding.js';
import { SIDE, Tiles } from './tiles.js';
import { joined, palette_rows, text_of } from './wire.js';

const STEP_MS = 60, NEWS_MS = 4000, NEWS_S = 12, CHANGED_MS = 2500;
const FIRST_RADIUS_M = 64;
/** The sample in a tile's middle. */
const MIDDLE = SIDE * SIDE / 2 + SIDE / 2;

export class MapPart {
  title = 'Map';
  element = make('section', { className: 'box world' });
  #main;
  #session;
  #tiles = new Tiles();
  #view;
  #history;
  #sounding;
  #state = make('p', { className: 'maptold', role: 'status', hidden: true });
  #boxing;
  #timer = 0;
  #news_timer = 0;
  #seen_tick = 0;
  #renewed_ms = -CHANGED_MS;
  #renewal = 0;
  #spawn = { x: 0, z: 0 };
  #placed = false;
  #palette = { digest: '', parts: [] };

  /** `hello`: as of Session. */
  constructor(main, hello) {
    this.#main = main;
    this.#session = new Session(hello, { changed: () => this.#told(), joined: (welcome) => this.#joined(welcome), message: (kind) => this.#take(kind) });
    this.#view = new MapView(this.#tiles, { place: (place) => this.#place(place), box: (box) => this.#choose(box) });
    this.#sounding = new Sounding(this.#session, this.#tiles, () => this.#view.draw());
    this.#history = new History(main, {
      height: ({ x, z }) => this.#tiles.at(x, z)?.height, chosen: (box) => this.#view.mark({ chosen: box }), marks: (marks) => this.#view.mark(marks),
      go: (box) => this.#go(box), changed: (box) => this.#changed(box),
    });
    this.#boxing = this.#button('box', 'Choose a box by dragging', () => this.#set_boxing(!this.#view.boxing));
    this.#boxing.setAttribute('aria-pressed', 'false');
    const bar = make('div', { className: 'mapbar', role: 'toolbar', aria: { label: 'Map' } }, this.#button('more', 'Nearer', () => this.#view.zoom(1.6)), this.#button('less', 'Farther', () => this.#view.zoom(1 / 1.6)),
      this.#boxing, this.#button('home', 'To where visitors begin', () => this.#view.go(this.#spawn)), this.#button('again', 'Ask for the ground again', () => this.#renew()));
    this.#view.element.append(bar, this.#state);
    this.element.append(make('h2', { className: 'away' }, 'Map, history and undo'), this.#view.element, this.#history.element);
  }

  /** The session of the map's connection. */
  owns(session) { return this.#session.phase === 'joined' && this.#session.welcome.session === session; }

  #button(name, does, act) {
    const made = make('button', { type: 'button', title: does, aria: { label: does } }, icon(name));
    made.addEventListener('click', act);
    return made;
  }

  // ---- what others tell it

  joined(welcome) {
    this.#history.joined(welcome);
    this.#spawn = welcome.spawn ?? { x: 0, y: 0, z: 0 };
    if (!this.#placed) this.#view.go(this.#spawn, FIRST_RADIUS_M);
    this.#placed = true;
    if (!this.element.hidden) this.shown();
  }

  regions(regions) {
    this.#view.mark({ regions: regions.map(({ name, form, centre, half }) => {
      const x = half.x, z = form === 0 ? half.z : half.x;
      return { name: text_of(name), round: form !== 0, lo: { x: centre.x - x, z: centre.z - z }, hi: { x: centre.x + x, z: centre.z + z } };
    }) });
  }

  show_place(place, radius_m) { this.#view.go(place, Math.max(radius_m, 8)); }

  shown() {
    if (this.#main.phase !== 'joined') return;
    if (this.#session.phase === 'off' || this.#session.phase === 'refused') this.#session.start();
    clearInterval(this.#timer);
    clearInterval(this.#news_timer);
    this.#timer = setInterval(() => this.#step(), STEP_MS);
    this.#news_timer = setInterval(() => this.#ask_news(), NEWS_MS);
    this.#history.shown();
    this.#view.draw();
  }

  hidden() {
    clearInterval(this.#timer);
    clearInterval(this.#news_timer);
    this.#history.hidden();
    this.#session.stop();
  }

  // ---- its own connection

  #told() {
    const { phase, why } = this.#session;
    this.#state.hidden = phase === 'joined' || phase === 'off';
    write(this.#state, phase === 'connecting' ? 'The map joins the world.' : phase === 'lost' ? `The map's connection is lost; it is tried again. ${why}` : why);
  }

  #joined(welcome) {
    this.#sounding.restart(welcome.heights);
    for (const tile of this.#tiles.all()) tile.asked.clear();
    const digest = String(welcome.palette);
    if (digest === this.#palette.digest || welcome.palette.length === 0) return;
    this.#ask_palette(welcome.palette);
  }

  #ask_palette(digest) {
    this.#palette = { digest: String(digest), parts: [] };
    this.#session.tell('content', { wanted: digest });
  }

  #take({ case: name, value }) {
    if (name === 'paletteChanged') this.#ask_palette(value.palette);
    if (name !== 'content' || String(value.digest) !== this.#palette.digest) return;
    this.#palette.parts.push(value.part);
    const bytes = joined(this.#palette.parts);
    if (value.total > 0 && bytes.length >= value.total) this.#view.colours(palette_rows(bytes));
  }

  #step() {
    if (document.hidden) return;
    const { x, z } = this.#view.centre;
    const distance = (tile) => { const middle = tile.place(MIDDLE); return Math.hypot(middle.x - x, middle.z - z); };
    const wanted = this.#view.size.width > 0 ? this.#tiles.within(this.#view.level, this.#view.seen, true).sort((a, b) => distance(a) - distance(b)) : [];
    const busy = this.#sounding.step(wanted);
    this.#view.element.toggleAttribute('data-busy', busy);
  }

  /** Asks anew where somebody edited since. */
  async #ask_news() {
    if (this.#main.phase !== 'joined' || document.hidden) return;
    const { text } = await this.#main.act('listHistory', { sinceS: NEWS_S, asJson: true }).catch(() => ({ text: null }));
    if (!text) return;
    const { edits, tick } = JSON.parse(text_of(text));
    for (const { tick: when, lo_m, hi_m } of edits)
      if (when > this.#seen_tick) this.#tiles.renew({ lo: { x: lo_m[0], z: lo_m[2] }, hi: { x: hi_m[0], z: hi_m[2] } });
    // Edits of a brick are remembered as one for a while, and come to the list a moment later than they are done.
    this.#seen_tick = Math.max(tick - 120, 0);
  }

  // ---- what people do

  #go({ lo, hi }) {
    this.#view.go({ x: (lo.x + hi.x) / 2, z: (lo.z + hi.z) / 2 }, Math.max(hi.x - lo.x, hi.z - lo.z, 12));
  }

  #set_boxing(on) {
    this.#view.boxing = on;
    this.#boxing.setAttribute('aria-pressed', String(on));
  }

  #choose(box) {
    this.#set_boxing(false);
    this.#history.choose(box);
  }

  /** A place is a box of some pixels about it. */
  #place(place) {
    const reach = Math.max(12 * this.#view.per_pixel, 1);
    this.#choose(place && { lo: { x: place.x - reach, z: place.z - reach }, hi: { x: place.x + reach, z: place.z + reach } });
  }

  #renew(box = null) {
    this.#tiles.renew(box);
    this.#view.draw();
  }

  /** While an undo goes on, not more often than the ground can be asked for. */
  #changed(box) {
    clearTimeout(this.#renewal);
    const wait_ms = Math.max(this.#renewed_ms + CHANGED_MS - performance.now(), 0);
    this.#renewal = setTimeout(() => {
      this.#renewed_ms = performance.now();
      this.#renew(box);
    }, wait_ms);
  }
}
