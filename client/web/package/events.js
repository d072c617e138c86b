// Events as plain objects, and the queues by which programs wait for them.
import { ScreeError } from './engine.js';
import { enums } from './layout.js';

/** Events that one iterator keeps for a program that does not take them; beyond, it ends with an error. */
const KEPT_MAX = 100_000;
const SIGNS = ['line', 'bar', 'marker'];

/** "PIECE_ADDED" to "pieceAdded". */
const camel = (name) => name.toLowerCase().replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

const by_id = ({ id }) => ({ id });
const first = ({ flags }) => (flags & 1) !== 0;

/** What an event of each kind has, of the struct's members and the engine. */
const ROWS = {
  joined: ({ session, tick, flags }) =>
    ({ session: Number(session), tick: Number(tick), otherWorld: (flags & 1) !== 0, recording: (flags & 2) !== 0 }),
  lost: ({ text, name, flags }) => ({ reason: text, refusal: name, final: (flags & 1) !== 0 }),
  frame: ({ tick }) => ({ tick: Number(tick) }),
  terrain: ({ tick, coords, coord_count }, engine) =>
    ({ tick: Number(tick), bricks: engine.copy(Int32Array, coords, 3 * coord_count) }),
  pieceAdded: by_id,
  pieceRemoved: by_id,
  bodyAdded: by_id,
  bodyRemoved: by_id,
  stone: ({ id, position, rotation }) => ({ id, position, rotation }),
  reply: ({ request, tick, number, id, name, text }) => ({
    request, tick: Number(tick), count: Number(number), id,
    error: name || text ? new ScreeError(name || 'refused', text) : null,
  }),
  status: () => ({}),
  palette: () => ({}),
  said: ({ session, name, text }) => ({ session: Number(session), name, text }),
  person: (event) => ({ session: Number(event.session), name: event.name, role: Number(event.number), first: first(event) }),
  message: ({ name, data, data_bytes }, engine) => ({ channel: name, bytes: engine.copy(Uint8Array, data, data_bytes) }),
  sign: (event) => ({
    name: event.name, text: event.text, position: event.position, form: SIGNS[Number(event.number)] ?? 'line',
    share: event.value, first: first(event),
  }),
  cue: ({ tick, name, position, value }) => ({ tick: Number(tick), name, position, energy: value }),
  contact: ({ tick, id, number, position, value }) => ({ tick: Number(tick), id, other: Number(number), position, energy: value }),
};

const NAMES = new Map();
for (const [name, value] of Object.entries(enums.scree_event_kind)) {
  const kind = camel(name.slice('SCREE_EVENT_'.length));
  if (!ROWS[kind]) throw new Error(`the package has no event ${kind}`);
  NAMES.set(value, kind);
}

/** The event at a place of the engine's memory. */
export function event_at(engine, at) {
  const told = engine.struct('scree_event', at);
  const kind = NAMES.get(told.kind);
  return { kind, ...ROWS[kind](told, engine) };
}

/** The events from its making on, for `for await`. */
export class EventQueue {
  #kept = [];
  #taken = 0;     // of those that are kept, from the first
  #waiting = [];  // of { resolve, reject }
  #over = false;
  #error = null;
  #left;

  /** `left` is called once, when no more is wanted. */
  constructor(left) {
    this.#left = left;
  }

  push(event) {
    if (this.#over) return;
    const next = this.#waiting.shift();
    if (next) return next.resolve({ value: event, done: false });
    this.#kept.push(event);
    if (this.#kept.length - this.#taken > KEPT_MAX)
      this.end(new ScreeError('too_slow', `${KEPT_MAX} events were not taken`));
  }

  /** No more come. What is kept is told before the error, if there is one. */
  end(error = null) {
    if (this.#over) return;
    this.#over = true;
    this.#error = error;
    this.#left(this);
    for (const { resolve, reject } of this.#waiting.splice(0)) {
      if (this.#take_error(error)) reject(error);
      else resolve({ value: undefined, done: true });
    }
  }

  #take_error(error) {
    if (error) this.#error = null;
    return error !== null;
  }

  async next() {
    if (this.#taken < this.#kept.length) return { value: this.#take(), done: false };
    const error = this.#error;
    if (this.#take_error(error)) throw error;
    if (this.#over) return { value: undefined, done: true };
    return new Promise((resolve, reject) => { this.#waiting.push({ resolve, reject }); });
  }

  /** The first that is kept. Places of those before go half of the list at a time. */
  #take() {
    const event = this.#kept[this.#taken];
    this.#kept[this.#taken++] = undefined;
    if (2 * this.#taken >= this.#kept.length) {
      this.#kept.splice(0, this.#taken);
      this.#taken = 0;
    }
    return event;
  }

  async return() {
    this.#kept = [];
    this.#taken = 0;
    this.end();
    return { value: undefined, done: true };
  }

  [Symbol.asyncIterator]() {
    return this;
  }
}
