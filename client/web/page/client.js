// The client, scree.wasm, as the page's modules use it: client/web/bridge.h says what each call does.
import { read_model } from './glb.js';
import createScree from './scree.js';

/** By how much scree.wasm is smaller compressed, about: a server says the compressed length alone. */
const COMPRESSED = 2.7;

/** Fetches scree.wasm; tells how many bytes have come, and about which part of it that is. */
export async function fetch_wasm(progress) {
  const answer = await fetch(new URL('scree.wasm', import.meta.url));
  if (!answer.ok) throw new Error(`the server has no scree.wasm (${answer.status})`);
  const length = Number(answer.headers.get('content-length')) || 2e6;
  const expected = answer.headers.get('content-encoding') ? length * COMPRESSED : length;
  const parts = [];
  let come = 0;
  for (const reader = answer.body.getReader(); ;) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    come += value.length;
    progress(come, Math.min(come / expected, 0.99));
  }
  return new Blob(parts).arrayBuffer();
}

export class Client {
  #wasm;

  static async load(canvas, wasmBinary) {
    const client = new Client();
    client.#wasm = await createScree({ canvas, wasmBinary, readModel: read_model });
    return client;
  }

  #number(name, ...values) { return this.#wasm[`_scree_${name}`](...values); }
  #text(name) { return this.#wasm.ccall(`scree_${name}`, 'string', [], []); }
  #tell(name, text) { return this.#wasm.ccall(`scree_${name}`, 'number', ['string'], [text]); }

  /** '' when it can draw; otherwise which of the two ways it can not: 'webgl' or 'other' (error() says it). */
  begin(selector) { return ['', 'webgl', 'other'][this.#tell('begin', selector)]; }
  error() { return this.#text('error'); }
  leave() { this.#number('leave'); }

  socket_wish() { return ['', 'open', 'close'][this.#number('socket_wish')]; }
  socket_opened() { this.#number('socket_opened'); }
  socket_closed(why) { this.#tell('socket_closed', why); }
  /** False: the message is too long. */
  receive(bytes) {
    const place = this.#number('incoming', bytes.length);
    if (!place) return false;
    this.#wasm.HEAPU8.set(bytes, place);
    this.#number('received', bytes.length);
    return true;
  }
  /** What is to be sent, as a copy; null: nothing. */
  take_outgoing() {
    const length = this.#number('outgoing');
    if (!length) return null;
    const place = this.#number('outgoing_bytes');
    return this.#wasm.HEAPU8.slice(place, place + length);
  }

  resize(width, height) { this.#number('resize', width, height); }
  frame() { return this.#number('frame') !== 0; }

  /** Sets a wish by its name in bridge.h, without "set_"; false: it is none that the client knows. */
  set(name, value) {
    if (typeof value === 'string') return this.#tell(`set_${name}`, value) !== 0;
    return this.#number(`set_${name}`, Number(value)) !== 0;
  }

  look(right, down) { this.#number('look', right, down); }
  move(right, up, forward, fast) { this.#number('move', right, up, forward, Number(fast)); }
  strike() { this.#number('strike'); }
  hold(on) { this.#number('hold', Number(on)); }
  reconnect() { this.#number('reconnect'); }
  grow(notches) { this.#number('grow', notches); }
  key(code, down) { return this.#wasm.ccall('scree_key', 'number', ['string', 'number'], [code, Number(down)]) !== 0; }
  keys_up() { this.#number('keys_up'); }
  gamepad(...state) { this.#number('gamepad', ...state); }
  act(action) { return this.#tell('act', action) !== 0; }
  asked() { return JSON.parse(this.#text('asked')); }

  /** What there is to hear of the last frame, as bytes for sound.wasm; null: nothing. */
  take_sounds() {
    const length = this.#number('sounds');
    if (!length) return null;
    const place = this.#number('sounds_bytes');
    return this.#wasm.HEAPU8.slice(place, place + length);
  }

  say(line) { return this.#tell('say', line) !== 0; }
  play(on) { this.#number('replay_play', Number(on)); }
  speed(factor) { return this.#number('replay_speed', factor) !== 0; }
  seek(tick) { this.#number('replay_seek', tick); }

  /** Bytes to the server's rules; false: they are too many, or there is no connection. */
  send(channel, bytes) {
    const place = this.#wasm._malloc(Math.max(bytes.length, 1));
    if (!place) return false;
    this.#wasm.HEAPU8.set(bytes, place);
    const sent = this.#wasm.ccall('scree_send', 'number', ['string', 'number', 'number'], [channel, place, bytes.length]);
    this.#wasm._free(place);
    return sent !== 0;
  }
  /** The next message of the rules, {channel, bytes}, as a copy; null: none. */
  take_heard() {
    const length = this.#number('heard') - 1;
    if (length < 0) return null;
    const place = this.#number('heard_bytes');
    return { channel: this.#text('heard_channel'), bytes: this.#wasm.HEAPU8.slice(place, place + length) };
  }

  catalogue() { return JSON.parse(this.#text('catalogue')); }
  state() { return JSON.parse(this.#text('state')); }
  names() { return JSON.parse(this.#text('names')); }
  /** As text; signs.js reads it. */
  signs() { return this.#text('signs'); }
  marks() { return JSON.parse(this.#text('marks')); }
}
