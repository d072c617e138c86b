// A connection of the page: joins by the server's WebSocket, asks, and joins again by itself when the connection is lost.
//
// `phase` is what people are told: 'off', 'connecting', 'joined', 'lost' (it is tried again at `retry_at_ms`), or 'refused'
// (the server said why, and nothing is tried).
import { Backoff } from '../page/backoff.js';
import { Socket, session_url } from '../page/socket.js';
import { PROTOCOL, Stream, bytes_of, framed, joined, text_of } from './wire.js';

const STEP_MS = 50, ACK_MS = 2000, ANSWER_MS = 15000;
/** A server takes no longer frames of a WebSocket. */
const FRAME_BYTES_MAX = 60000;

/** Refusals after which the page does not come again by itself: a person has to do something first. */
const FINAL = new Set(['admin_token_wrong', 'banned', 'kicked', 'protocol_version', 'tls_required']);

/** The refusal of a request, in the server's words; `reason` is for programs. */
export class Refused extends Error {
  constructor(words, reason = '') {
    super(words);
    this.reason = reason;
  }
}

export class Session {
  phase = 'off';
  /** Why it is 'lost' or 'refused', in words; the name of a refusal. */
  why = '';
  why_name = '';
  retry_at_ms = 0;
  welcome = null;
  #hello;
  #on;
  #socket;
  #wants = '';
  #outgoing = [];
  #stream = new Stream();
  #waiting = new Map();
  #number = 0;
  #timer = 0;
  #acked_ms = 0;
  #tick = 0n;
  #backoff = new Backoff();

  /** `hello`: its fields but those of every hello, called at each attempt. `on`: {changed(), joined(welcome), message({case, value})}. */
  constructor(hello, on, location = globalThis.location) {
    this.#hello = hello;
    this.#on = on;
    this.#socket = new Socket(this, session_url(location));
  }

  start() {
    clearInterval(this.#timer);
    this.#timer = setInterval(() => this.#step(), STEP_MS);
    this.#connect();
  }

  stop(phase = 'off', why = '', why_name = '') {
    clearInterval(this.#timer);
    if (this.phase === 'joined') {
      this.#send('goodbye', {});
      this.#socket.step();
    }
    this.#wants = 'close';
    this.#socket.step();
    this.#end('the connection was closed');
    this.#tell(phase, why, why_name);
  }

  /** Tries at once where it waits. */
  retry() {
    if (this.phase === 'lost') this.#connect();
    else if (this.phase === 'refused' || this.phase === 'off') this.start();
  }

  /** An act of an administrator: its AdminList, or its Reply. Rejects with the refusal, or when no answer comes. */
  act(act, value = {}) { return this.#ask('admin', (request) => ({ request, act: { case: act, value } })); }

  /** Settings, by name. */
  set(settings) {
    return this.#ask('admin', (request) => ({ request, settings: Object.entries(settings).map(([name, value]) => ({ name: bytes_of(name), value: bytes_of(value) })) }));
  }

  /** A request of the world, such as setRegion. */
  request(kind, value) { return this.#ask(kind, (request) => ({ request, ...value })); }

  /** Questions about space: the Answer, also one that refuses all of them. It may take long: the server works at them beside its ticks. */
  query(questions) { return this.#ask('query', (query) => ({ query, questions }), 0); }

  tell(kind, value) {
    if (this.phase === 'joined') this.#send(kind, value);
  }

  #ask(kind, fill, within_ms = ANSWER_MS) {
    if (this.phase !== 'joined') return Promise.reject(new Refused('There is no connection to the server now.', 'lost'));
    const number = ++this.#number;
    return new Promise((resolve, reject) => {
      const late = within_ms ? setTimeout(() => this.#settle(number, () => reject(new Refused('The server did not answer in time.', 'late'))), within_ms) : 0;
      this.#waiting.set(number, { resolve, reject, late });
      this.#send(kind, fill(number));
    });
  }

  #settle(number, act) {
    const waiting = this.#waiting.get(number);
    if (!waiting) return;
    clearTimeout(waiting.late);
    this.#waiting.delete(number);
    act(waiting);
  }

  #send(kind, value) {
    this.#outgoing.push(framed(kind, value));
    this.#socket.step();
  }

  #connect() {
    this.#wants = 'open';
    this.#tell('connecting');
    this.#socket.step();
  }

  #step() {
    if (this.phase === 'lost' && performance.now() >= this.retry_at_ms) return this.#connect();
    if (this.phase === 'joined' && performance.now() - this.#acked_ms > ACK_MS) {
      this.#acked_ms = performance.now();
      this.#send('ack', { tick: this.#tick });
    }
    this.#socket.step();
  }

  #tell(phase, why = '', why_name = '') {
    Object.assign(this, { phase, why, why_name });
    this.#on.changed();
  }

  #end(words) {
    this.#outgoing = [];
    this.#stream = new Stream();
    for (const number of [...this.#waiting.keys()]) this.#settle(number, ({ reject }) => reject(new Refused(words, 'lost')));
  }

  #take(kind) {
    const { case: name, value } = kind;
    if (name === 'welcome') {
      this.welcome = value;
      this.#backoff.well();
      this.#acked_ms = performance.now();
      this.#tell('joined');
      this.#on.joined(value);
    } else if (name === 'refusal') {
      const words = text_of(value.reason), refusal = text_of(value.name);
      if (FINAL.has(refusal) || refusal.startsWith('token_')) this.stop('refused', words, refusal);
      else this.why = words;
    } else if (name === 'reply') {
      const words = text_of(value.refusal);
      this.#settle(value.request, ({ resolve, reject }) => (words ? reject(new Refused(words, text_of(value.refusalName))) : resolve(value)));
    } else if (name === 'adminList') {
      this.#settle(value.request, ({ resolve }) => resolve(value));
    } else if (name === 'answer') {
      this.#settle(value.query, ({ resolve }) => resolve(value));
    } else {
      if (name === 'status') this.#tick = value.tick;
      this.#on.message(kind);
    }
  }

  // ---- what the socket asks (../page/socket.js)

  socket_wish() {
    const wish = this.#wants;
    this.#wants = '';
    return wish;
  }

  socket_opened() {
    this.#outgoing = [];
    this.#stream = new Stream();
    this.why = '';
    this.#outgoing.push(framed('hello', { protocol: PROTOCOL, oldestProtocol: PROTOCOL, client: bytes_of('scree admin page'), lacksKernels: true, eye: {}, ...this.#hello() }));
  }

  socket_closed(words) {
    if (this.phase === 'refused' || this.phase === 'off') return;
    this.#end('The connection was lost.');
    this.retry_at_ms = performance.now() + this.#backoff.failed();
    this.#tell('lost', words || this.why);
  }

  receive(bytes) { return this.#stream.receive(bytes, (kind) => this.#take(kind)); }

  take_outgoing() {
    const parts = [];
    for (let bytes = 0; this.#outgoing.length && (parts.length === 0 || bytes + this.#outgoing[0].length <= FRAME_BYTES_MAX);) {
      bytes += this.#outgoing[0].length;
      parts.push(this.#outgoing.shift());
    }
    return parts.length ? joined(parts) : null;
  }
}
