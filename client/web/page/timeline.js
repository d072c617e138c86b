// The timeline of a replay: a row for each kind of event, brighter where there were more; dragging goes through it.
import { $, button, make, write } from './dom.js';
import { events_near, part_of, rows_of, span_of, tick_at } from './marks.js';
import { time } from './words.js';

const SPEEDS = [-4, -1, 0.1, 0.25, 0.5, 1, 2, 4, 8, 16];
const NEAR_PIXELS = 4;
const COLOURS = {
  carve: '#ffb340', fill: '#73e680', paint: '#f299e6', dent: '#bfa680', crush: '#d9734d', break: '#ff665a', fall: '#faeb66',
  merge: '#66bfff', setting: '#b399ff', rebuild: '#d9d9d9', join: '#5ae6d9', leave: '#4d9999', slow: '#ff4da6',
  contact: '#e6d9bf', joint_ended: '#cc8c33', prop_added: '#99cc4d', prop_removed: '#738c40',
  region_enter: '#59a6f2', region_leave: '#4066b3',
  hurt: '#ff3333', buried: '#994033',
  dig: '#a680e6', place: '#73bfe6',
};

export class Timeline {
  #client;
  #canvas = make('canvas', { aria: { hidden: 'true' } });
  #played = make('div', { className: 'played' });
  #hand = make('div', { className: 'hand' });
  #track;
  #time = make('span', { className: 'time' });
  #near = make('span', { className: 'near' });
  #legend = make('div', { className: 'legend' });
  #speed = make('select', { title: 'Speed', aria: { label: 'Speed' } });
  #play;
  #controls = [];
  #marks = null;
  #drawn = '';
  #playback = null;
  #rate_hz = 60;
  #dragged = null;

  /** `back`: to the world that this is a replay of; null: nobody knows it. */
  constructor(client, back = null) {
    this.#client = client;
    this.#track = make('div', { className: 'track', role: 'slider', tabIndex: 0, aria: { label: 'Moment of the recording', valuemin: '0' } },
      this.#canvas, this.#played, this.#hand);
    const act = (name, does, action) => button(name, does, () => client.act(action));
    this.#play = act('play', 'Play or hold (J)', 'replay_play');
    this.#controls = [act('before', 'The previous event (9)', 'replay_previous_event'), this.#play,
      act('next', 'The next event (0)', 'replay_next_event'), act('turn', 'Backwards or forwards (Y)', 'replay_turn'), this.#speed];
    const home = back ? [button('present', 'Back to the present (Backspace)', back)] : [];
    for (const factor of SPEEDS) this.#speed.append(make('option', { value: factor }, `${factor} ×`));
    this.#speed.addEventListener('change', () => client.speed(Number(this.#speed.value)));
    $('timeline').append(this.#track, make('div', { className: 'under' }, ...this.#controls, ...home, this.#time, this.#near), this.#legend);
    this.#listen();
  }

  #listen() {
    const place = (event) => {
      const box = this.#track.getBoundingClientRect();
      return (event.clientX - box.left) / box.width;
    };
    const seek = (event) => {
      this.#dragged = tick_at(place(event), this.#playback);
      this.#client.seek(this.#dragged);
      this.#place_hand(this.#dragged);
    };
    this.#track.addEventListener('pointerdown', (event) => {
      if (!this.#playback || this.#playback.refusal) return;
      this.#track.setPointerCapture(event.pointerId);
      seek(event);
    });
    this.#track.addEventListener('pointermove', (event) => {
      if (this.#dragged !== null) seek(event);
      this.#tell(place(event));
    });
    for (const end of ['pointerup', 'pointercancel']) this.#track.addEventListener(end, () => { this.#dragged = null; });
    this.#track.addEventListener('pointerleave', () => this.#tell(null));
    this.#track.addEventListener('keydown', (event) => this.#key(event));
    new ResizeObserver(() => { this.#drawn = ''; }).observe(this.#track);
  }

  /** With the bar in focus, as a slider does; a key that went here does nothing else. */
  #key(event) {
    const actions = { ArrowLeft: 'replay_second_back', ArrowRight: 'replay_second_on', Home: 'replay_start', End: 'replay_end' };
    if (!actions[event.code]) return;
    this.#client.act(actions[event.code]);
    event.preventDefault();
  }

  follow({ playback, tick_rate_hz }) {
    this.#playback = playback;
    $('timeline').hidden = playback === null;
    document.body.toggleAttribute('data-replay', playback !== null);
    if (playback === null) return;
    this.#rate_hz = tick_rate_hz;
    for (const control of this.#controls) control.disabled = playback.refusal !== '';
    this.#play.querySelector('use').setAttribute('href', playback.playing ? '#i-hold' : '#i-play');
    this.#show_speed(playback.speed);
    if (this.#dragged === null) this.#place_hand(playback.moment);
    this.#draw_marks();
    if (!this.#near.textContent) this.#tell(null);
  }

  #show_speed(speed) {
    if (document.activeElement === this.#speed) return;
    const value = String(speed);
    if (![...this.#speed.options].some((one) => one.value === value)) this.#speed.append(make('option', { value }, `${value} ×`));
    this.#speed.value = value;
  }

  #place_hand(tick) {
    const part = part_of(tick, this.#playback);
    this.#played.style.width = `${100 * part}%`;
    this.#hand.style.left = `${100 * part}%`;
    const text = `${time(tick, this.#rate_hz)} of ${time(this.#playback.last, this.#rate_hz)}`;
    write(this.#time, text);
    this.#track.setAttribute('aria-valuemax', String(this.#playback.last));
    this.#track.setAttribute('aria-valuenow', String(Math.round(tick)));
    this.#track.setAttribute('aria-valuetext', text);
  }

  /** What happened where the mouse points, or else why one may only look on. */
  #tell(part) {
    const playback = this.#playback;
    if (!playback) return;
    if (part === null || !this.#marks) {
      write(this.#near, playback.refusal ? `You may only look on: ${playback.refusal}` : playback.grows ? 'being recorded' : '');
      return;
    }
    const near = events_near(part, NEAR_PIXELS / this.#track.clientWidth, this.#marks, playback);
    write(this.#near, `${time(tick_at(part, playback), this.#rate_hz)}${near ? `: ${near}` : ''}`);
  }

  #draw_marks() {
    const { marks: told, first, last } = this.#playback;
    const drawn = `${told} ${first} ${last}`;
    if (drawn === this.#drawn) return;
    this.#drawn = drawn;
    this.#marks = this.#client.marks();
    const rows = rows_of(this.#marks);
    const { clientWidth: width, clientHeight: height } = this.#track;
    const ratio = devicePixelRatio;
    Object.assign(this.#canvas, { width: width * ratio, height: height * ratio });
    const pen = this.#canvas.getContext('2d');
    pen.scale(ratio, ratio);
    const order = [...rows.keys()];
    const row = height / Math.max(order.length, 1);
    for (const { kind, column, count } of this.#marks.marks) {
      const [left, right] = span_of(column, this.#marks, this.#playback);
      pen.globalAlpha = 0.55 + 0.45 * Math.log1p(count) / Math.log1p(rows.get(kind));
      pen.fillStyle = COLOURS[kind] ?? 'white';
      pen.fillRect(left * width, order.indexOf(kind) * row, Math.max((right - left) * width, 2), Math.max(row - 1, 1));
    }
    this.#legend.replaceChildren(...order.map((kind) => {
      const square = make('i');
      square.style.setProperty('--colour', COLOURS[kind] ?? 'white');
      return make('span', {}, square, kind);
    }));
  }
}
