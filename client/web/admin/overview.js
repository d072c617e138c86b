// The server at a glance: what it says each second, whether it is well, its last hour, and why ticks were slow.
import { make, write } from '../page/dom.js';
import { bytes, ms, whole } from '../page/words.js';
import { Charts } from './charts.js';
import { ask_lines } from './json_lines.js';
import { Rows } from './rows.js';
import { text_of } from './wire.js';

const FIGURES_EVERY_MS = 10000;
const SLOW_ROWS = 12;

export class Overview {
  title = 'Overview';
  element = make('section', { className: 'overview' });
  #session;
  #heads = new Map();
  #health = make('ul', { className: 'faults', aria: { label: 'Health' } });
  #saved = make('p', { className: 'dim' });
  #charts;
  #slow = new Rows('Slow ticks', [
    { title: 'when', text: ({ unixMs }) => new Date(Number(unixMs)).toLocaleTimeString() },
    { title: 'late by', className: 'number', text: ({ lateMs }) => ms(lateMs) },
    { title: 'likely cause', className: 'wide', text: ({ words, culprit }) => text_of(words) || text_of(culprit) },
  ], 'No tick was slow in the last ten minutes.');
  #timer = 0;
  #tick_ms = 1000 / 60;

  constructor(session) {
    this.#session = session;
    this.#charts = new Charts(this.#kinds());
    const heads = make('div', { className: 'heads' });
    for (const name of ['Tick, median', 'Late ticks', 'Persons', 'Pieces', 'Memory', 'Sent']) {
      const head = { value: make('span', {}, '–'), beside: make('small', {}, '\u00a0') };
      head.element = make('div', { className: 'head box' }, make('h3', {}, name), make('p', { className: 'value' }, head.value, head.beside));
      this.#heads.set(name, head);
      heads.append(head.element);
    }
    this.element.append(make('h2', { className: 'away' }, 'Overview'), heads, make('div', { className: 'box well' }, this.#health, this.#saved), this.#charts.element,
      make('section', { className: 'box' }, make('h2', {}, 'Slow ticks'), this.#slow.element));
  }

  #kinds() {
    const curve = (member, name = '') => ({ name, number: (sample) => sample[member] });
    return [
      { title: 'Tick', curves: [curve('tick_ms', 'mean'), curve('tick_ms_max', 'worst')], say: ms, limit: () => this.#tick_ms },
      { title: 'Late ticks', curves: [curve('late')], say: whole, least: 10 },
      { title: 'Persons', curves: [curve('sessions')], say: whole, least: 5 },
      { title: 'Pieces', curves: [curve('pieces')], say: whole, least: 10 },
      { title: 'Bodies, with props', curves: [curve('bodies')], say: whole, least: 10 },
      { title: 'Sent a second', curves: [curve('sent_bytes_s')], say: bytes, least: 10000 },
      { title: 'Memory', curves: [curve('memory_mb')], say: (mb) => `${whole(mb)} MB`, least: 100 },
      { title: 'Requests', curves: [curve('requests')], say: whole, least: 10 },
      { title: 'Refused', curves: [curve('refused')], say: whole, least: 10 },
    ];
  }

  #head(name, value, beside, bad = false) {
    const head = this.#heads.get(name);
    write(head.value, value);
    write(head.beside, beside);
    head.element.toggleAttribute('data-bad', bad);
  }

  joined(welcome) { this.#tick_ms = 1000 / welcome.tickRateHz; }

  /** Once a second. */
  status(status) {
    this.#head('Tick, median', ms(status.tickMedianMs), `worst ${ms(status.tickWorstMs)}`, status.tickMedianMs > this.#tick_ms);
    this.#head('Pieces', whole(status.pieces), `${whole(Number(status.piecesMade))} made so far`);
    this.#head('Persons', whole(status.clients), 'that are there');
    const refused = status.refusals.reduce((sum, { count }) => sum + Number(count), 0);
    const saving = text_of(status.saving);
    write(this.#saved, `${saving ? `Saved up to tick ${whole(Number(status.savedTick))} of ${whole(Number(status.tick))} (${saving}).` : 'The world ends with the server: it has no file.'} `
      + `Refused since the start: ${whole(refused)}.`);
    this.#saved.toggleAttribute('data-bad', saving === 'retrying');
  }

  shown() {
    this.#refresh();
    clearInterval(this.#timer);
    this.#timer = setInterval(() => this.#refresh(), FIGURES_EVERY_MS);
  }

  hidden() { clearInterval(this.#timer); }

  async #refresh() {
    if (this.#session.phase !== 'joined' || document.hidden) return;
    await Promise.allSettled([this.#ask_figures(), this.#ask_health(), this.#ask_slow()]);
  }

  async #ask_figures() {
    const samples = (await ask_lines(this.#session, 'figures')).map((sample) => ({ ...sample, at_ms: Date.parse(sample.time) })).filter(({ at_ms }) => Number.isFinite(at_ms));
    const last = samples.at(-1);
    this.#charts.show(samples, last?.at_ms ?? Date.now());
    if (!last) return;
    const late = samples.reduce((sum, one) => sum + (one.late ?? 0), 0);
    this.#head('Late ticks', whole(late), 'in the last hour', (last.late ?? 0) > 0);
    this.#head('Memory', `${whole(last.memory_mb ?? 0)} MB`, 'of the process');
    this.#head('Sent', bytes(last.sent_bytes_s ?? 0), 'a second');
  }

  async #ask_health() {
    const answer = await fetch('healthz', { cache: 'no-store', signal: AbortSignal.timeout(5000) });
    const { well, ready, faults } = await answer.json();
    const lines = faults.map(({ name, words }) => [`${name}: ${words}`, true]);
    if (well && ready && lines.length === 0) lines.push(['The server is well, and ready for players.', false]);
    const shown = lines.map(([text]) => text).join('\n');
    if (this.#health.dataset.shown === shown) return;
    this.#health.dataset.shown = shown;
    this.#health.replaceChildren(...lines.map(([text, bad]) => {
      const line = make('li', {}, text);
      line.toggleAttribute('data-bad', bad);
      return line;
    }));
  }

  async #ask_slow() {
    const { slowTicks } = await this.#session.act('listFlight', { list: 0, sinceS: 600, most: 0 });
    this.#slow.show(slowTicks.slice(-SLOW_ROWS).reverse(), ({ tick }) => String(tick));
  }
}
