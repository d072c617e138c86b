// A client: an engine, its socket, and the timer by which both go on.
import { read_bodies } from './bodies.js';
import { Connection, session_url } from './connection.js';
import { Engine, ScreeError, no_engine, whole } from './engine.js';
import { EventQueue, event_at } from './events.js';
import { values } from './layout.js';
import { Mesher, mask_of, single_mesh } from './mesher.js';
import { REQUESTS, cell, send_request, triple } from './requests.js';

/** Milliseconds from one step to the next, where nothing comes: acknowledgements and attempts need no more. */
const IDLE_MS = 50;
/** The same where motions are shown, or requests before they are answered. */
const LIVELY_MS = 8;
/** A step that took so long has probably left messages: the next one follows at once. */
const BUSY_MS = 3;
/** Bytes of edits that are kept for the next connection of the same client. */
const CACHE_BYTES = 16 << 20;

const TRUTHS = new Set(['connected', 'loaded', 'on_foot', 'inside', 'exact']);
const KINDS_OF_HIT = ['terrain', 'piece', 'body'];

/** "tick_rate_hz" to "tickRate": without the unit, which the types tell. */
function plain(struct) {
  const value = {};
  for (const name of struct.names) {
    if (name === 'size') continue;
    const member = struct[name];
    const key = name.replace(/_(m|hz|j|kg_m3)$/, '').replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
    if (TRUTHS.has(name)) value[key] = member !== 0;
    else value[key] = typeof member === 'bigint' && !name.endsWith('_hash') ? Number(member) : member;
  }
  return value;
}

function flags_of(options, url) {
  const rows = [
    [url.protocol === 'wss:', values.SCREE_TLS], [options.insecureToken, values.SCREE_INSECURE_TOKEN],
    [options.eye === undefined || options.eye === null, values.SCREE_AT_SPAWN], [options.predict, values.SCREE_PREDICT],
    [options.smooth, values.SCREE_SMOOTH], [options.stones, values.SCREE_STONES], [options.once, values.SCREE_ONCE],
    [options.meets, values.SCREE_MEETS],
  ];
  return rows.reduce((flags, [on, flag]) => (on ? flags | flag : flags), 0);
}

export class Client {
  #engine;
  #client = 0;
  #connection;
  #pace_ms;
  #timer;
  #over = null;             // the error of all calls from now on
  #joining;                 // { resolve, reject } of connect()
  #replies = new Map();     // by number: { resolve, reject }
  #queues = new Set();
  #meshers = new Set();
  #closing = null;          // the promise of the socket's end
  #version = '';
  #protocol = 0;

  /** Joins a server. `runtime`: { module, WebSocket }. */
  static async join(address, options, runtime) {
    const url = session_url(address);
    const client = new Client();
    client.#engine = await Engine.create(runtime.module);
    client.#version = client.#engine.text(client.#engine.call.scree_version());
    client.#protocol = client.#engine.call.scree_protocol();
    client.#pace_ms = options.smooth || options.predict ? LIVELY_MS : IDLE_MS;
    client.#connection = new Connection(client.#engine, url, options.WebSocket ?? runtime.WebSocket, () => client.#step());
    client.#create(options, url);
    await new Promise((resolve, reject) => {
      client.#joining = { resolve, reject };
      client.#step();
    });
    return client;
  }

  #create(options, url) {
    const engine = this.#engine, bytes = engine.size_of('scree_options');
    const at = engine.room(bytes + 4);
    engine.check(engine.call.scree_options_init(at, bytes));
    engine.with_texts((texts) => {
      engine.write('scree_options', at, {
        flags: flags_of(options, url), host: url.hostname, connect_ms: options.connectMilliseconds ?? 0, token: options.token,
        name: options.name, program: options.program ?? 'scree-client.js', eye_m: options.eye ? triple(options.eye, 'the eye') : [0, 0, 0],
        radius_m: options.radius ?? 0, cache_bytes: whole(options.cacheBytes ?? CACHE_BYTES, [0, 2 ** 30], 'cacheBytes'), contacts_j: options.contacts ?? 0,
      }, texts);
      engine.check(engine.call.scree_client_create(at, at + bytes));
    });
    this.#client = engine.word(at + bytes);
  }

  // ---- the engine's steps

  #step() {
    if (this.#over) return;
    clearTimeout(this.#timer);
    const begun = performance.now();
    try {
      this.#engine.check(this.#engine.call.scree_client_poll(this.#client, 0));
      this.#take_events();
      if (this.#over) return;
      this.#connection.step();
    } catch (error) {
      this.#end(error);
      return;
    }
    this.#step_after(performance.now() - begun > BUSY_MS ? 0 : this.#pace_ms);
  }

  #step_after(milliseconds) {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#step(), milliseconds);
  }

  #take_events() {
    const engine = this.#engine, bytes = engine.size_of('scree_event');
    while (!this.#over) {
      const at = engine.room(bytes);
      engine.set_word(at, bytes);
      if (!engine.check(engine.call.scree_client_next(this.#client, at))) return;
      const event = event_at(engine, at);
      if (event.kind === 'reply') this.#answer(event);
      for (const queue of this.#queues) queue.push(event);
      if (event.kind === 'joined' && this.#joining) {
        // What follows is told after the program has had time to ask for events.
        this.#joining.resolve();
        this.#joining = null;
        return;
      }
      if (event.kind === 'lost') this.#lose(event);
    }
  }

  #answer(reply) {
    const waiting = this.#replies.get(reply.request);
    this.#replies.delete(reply.request);
    if (reply.error) waiting?.reject(reply.error);
    else waiting?.resolve(reply);
  }

  #lose({ reason, refusal, final }) {
    if (!final && !this.#joining) return;
    this.#end(new ScreeError(refusal || 'connection_lost', reason));
  }

  /** Nothing goes on after this. */
  #end(error) {
    if (this.#over) return;
    this.#over = error;
    clearTimeout(this.#timer);
    this.#joining?.reject(error);
    for (const { reject } of this.#replies.values()) reject(error);
    this.#replies.clear();
    const closed = error.name === 'closed';
    for (const queue of [...this.#queues]) {
      if (closed) queue.return();
      else queue.end(error);
    }
    for (const mesher of [...this.#meshers]) mesher.forget(error);
    const client = this.#client;
    this.#client = 0;
    try {
      this.#engine.call.scree_client_destroy(client);
      this.#connection.send();
    } catch {
      // An engine that has failed can say no goodbye.
    }
    this.#closing = this.#connection.close();
    this.#engine = no_engine(error);
  }

  #alive() {
    if (this.#over) throw this.#over;
    return this.#client;
  }

  /** Says goodbye. Resolves when the socket is closed; nothing of this client keeps a program running then. */
  async close() {
    this.#end(new ScreeError('closed', 'the client is closed'));
    await this.#closing;
  }

  /** Of the engine, and of the protocol that it speaks. */
  get version() {
    return this.#version;
  }
  get protocol() {
    return this.#protocol;
  }

  // ---- events and requests

  events() {
    const queue = new EventQueue((left) => this.#queues.delete(left));
    if (this.#over) queue.end(this.#over.name === 'closed' ? null : this.#over);
    else this.#queues.add(queue);
    return queue;
  }

  async loaded() {
    const is_loaded = () => this.status().loaded && this.material(0) !== null;
    if (is_loaded()) return;
    for await (const { kind } of this.events()) if (kind !== 'lost' && is_loaded()) return;
    this.#alive();
  }

  /** Sends a request by its name. */
  async request(name, given = {}) {
    if (!REQUESTS.includes(name)) throw new ScreeError('invalid', `there is no request "${name}"`);
    const look_up = { pattern: (pattern) => this.#pattern(pattern), material: (material) => this.#material(material) };
    const number = send_request(this.#engine, this.#alive(), name, given, look_up);
    const reply = new Promise((resolve, reject) => { this.#replies.set(number, { resolve, reject }); });
    this.#connection.send();
    if (this.#pace_ms === LIVELY_MS) this.#step_after(0); // the prediction shows
    return reply;
  }

  #pattern(name) {
    if (name === undefined) return undefined;
    return this.#number_of('pattern', name, (text, at) => this.#engine.call.scree_find_pattern(text, at));
  }

  #material(name) {
    if (name === undefined) return undefined;
    if (typeof name === 'number') return whole(name, [0, 254], 'a material');
    return this.#number_of('material', name, (text, at) => this.#engine.call.scree_client_find_material(this.#client, text, at));
  }

  #number_of(what, name, find) {
    if (typeof name !== 'string') throw new ScreeError('invalid', `a ${what} is a name`);
    const at = this.#engine.room(4);
    if (!this.#engine.with_texts((texts) => this.#engine.check(find(texts.add(name), at))))
      throw new ScreeError('invalid', `there is no ${what} "${name}"`);
    return this.#engine.word(at);
  }

  // ---- other messages

  follow(eye, radius) {
    const at = this.#floats(triple(eye, 'the eye'));
    this.#engine.check(this.#engine.call.scree_client_follow(this.#alive(), at, radius));
    this.#connection.send();
  }

  say(text) {
    this.#engine.with_texts((texts) => this.#engine.check(this.#engine.call.scree_client_say(this.#alive(), texts.add(text))));
    this.#connection.send();
  }

  send(channel, data) {
    if (typeof data !== 'string' && !(data instanceof ArrayBuffer) && !ArrayBuffer.isView(data))
      throw new ScreeError('invalid', 'what is sent is a text, or bytes');
    const bytes = typeof data === 'string' ? new TextEncoder().encode(data) : new Uint8Array(data.buffer ?? data, data.byteOffset ?? 0, data.byteLength);
    const at = this.#engine.room(bytes.length + 1);
    this.#engine.view(Uint8Array, at, bytes.length).set(bytes);
    this.#engine.with_texts((texts) =>
      this.#engine.check(this.#engine.call.scree_client_send(this.#alive(), texts.add(channel), at, bytes.length)));
    this.#connection.send();
  }

  walk({ way = [0, 0], jump = false, run = false, look = [0, 0, -1] }) {
    const at = this.#floats([...way, ...triple(look, 'the look')]);
    const sent = this.#engine.check(this.#engine.call.scree_client_walk(this.#alive(), at, (jump ? 1 : 0) | (run ? 2 : 0), at + 8));
    this.#connection.send();
    return sent;
  }

  // ---- the copy of the world

  status() {
    return plain(this.#filled('scree_status', (at) => this.#engine.call.scree_client_status(this.#alive(), at)));
  }

  prop(id) {
    const row = this.#filled('scree_prop', (at) => this.#engine.call.scree_client_prop(this.#alive(), id, at));
    if (!row) return null;
    return {
      motion: ['dynamic', 'kinematic', 'fixed'][row.motion], material: row.material, mass: row.mass_kg, tag: Number(row.tag),
      session: Number(row.session), data: row.data === 0 ? null : this.#engine.copy(Uint8Array, row.data, row.data_bytes),
    };
  }

  material(number) {
    whole(number, [0, 2 ** 32 - 1], 'a material');
    const row = this.#filled('scree_material', (at) => this.#engine.call.scree_client_material(this.#alive(), number, at));
    return row && plain(row);
  }

  findMaterial(name) {
    this.#alive();
    if (typeof name !== 'string') throw new ScreeError('invalid', 'a material is found by its name');
    return this.#material(name);
  }

  carried(material) {
    this.#alive();
    if (material === undefined) throw new ScreeError('invalid', 'a material is a name or a number');
    const number = this.#material(material), at = this.#engine.room(8);
    this.#engine.check(this.#engine.call.scree_client_carried(this.#alive(), number, at));
    return Number(this.#engine.memory.getBigInt64(at, true));
  }

  drawTick() {
    const at = this.#engine.room(8);
    this.#engine.check(this.#engine.call.scree_client_draw_tick(this.#alive(), at));
    return this.#engine.memory.getFloat64(at, true);
  }

  bodies(tick = -1, into = null) {
    const client = this.#alive();
    return read_bodies(this.#engine, into, (columns, room, count) => this.#engine.call.scree_client_body_columns(client, tick, columns, room, count));
  }

  // ---- questions about space

  cast(from, direction, { most = 100, radius = 0, of } = {}) {
    const along = triple(direction, 'a direction'), length = Math.hypot(...along);
    const places = this.#floats([...triple(from, 'a place'), ...along.map((x) => x / length)]);
    return this.#hit((at) => this.#engine.call.scree_client_cast(this.#alive(), places, places + 12, most, radius, mask_of(of), at), places + 24);
  }

  nearest(place, { most = 8, of } = {}) {
    const at_place = this.#floats(triple(place, 'a place'));
    return this.#hit((at) => this.#engine.call.scree_client_nearest(this.#alive(), at_place, most, mask_of(of), at), at_place + 16);
  }

  overlap(place, radius, { of } = {}) {
    const engine = this.#engine, client = this.#alive();
    let room = 256, count = 0, at = 0;
    do {
      room = Math.max(room, count);
      at = engine.room(20 + 4 * room);
      engine.view(Float32Array, at, 3).set(triple(place, 'a place'));
      const result = engine.call.scree_client_overlap(client, at, radius, mask_of(of), at + 12, at + 20, room, at + 16);
      if (result !== values.SCREE_TOO_SMALL) engine.check(result);
      count = engine.word(at + 16);
    } while (count > room);
    return { terrain: engine.word(at + 12) === 1, ids: engine.copy(Uint32Array, at + 20, count) };
  }

  distances(places) {
    const count = places?.length / 3;
    if (!Number.isInteger(count)) throw new ScreeError('invalid', 'places are one list, with three numbers for each');
    const at = this.#engine.room(16 * count + 4);
    this.#engine.view(Float32Array, at, 3 * count).set(places);
    this.#engine.check(this.#engine.call.scree_client_distances(this.#alive(), at, count, at + 12 * count));
    return this.#engine.copy(Float32Array, at + 12 * count, count);
  }

  codes(lo, hi) {
    const from = cell(lo, 'lo'), to = cell(hi, 'hi');
    const count = [0, 1, 2].reduce((product, i) => product * Math.max(to[i] - from[i], 0), 1);
    if (!(count <= 2 ** 24)) throw new ScreeError('invalid', 'the box has more than 2^24 voxels');
    const at = this.#engine.room(24 + count);
    this.#engine.view(Int32Array, at, 6).set([...from, ...to]);
    this.#engine.check(this.#engine.call.scree_client_codes(this.#alive(), at, at + 12, at + 24, count));
    return this.#engine.copy(Int8Array, at + 24, count);
  }

  // ---- meshes

  mesher(options = {}) {
    const mesher = new Mesher(this.#engine, this.#alive(), options, (left) => this.#meshers.delete(left));
    this.#meshers.add(mesher);
    return mesher;
  }

  meshChunk(chunk) {
    return single_mesh(this.#engine, this.#alive(), (mesh, place) => {
      this.#engine.view(Int32Array, place, 3).set(cell(chunk, 'a chunk'));
      return this.#engine.call.scree_client_mesh_chunk(this.#client, place, mesh);
    });
  }

  meshBody(id) {
    return single_mesh(this.#engine, this.#alive(), (mesh) => this.#engine.call.scree_client_mesh_body(this.#client, id, mesh));
  }

  // ---- memory

  /** Numbers in the engine's memory, with room behind them for a hit. */
  #floats(numbers) {
    const at = this.#engine.room(4 * numbers.length + 128);
    this.#engine.view(Float32Array, at, numbers.length).set(numbers);
    return at;
  }

  /** A struct that a function fills; null: there is none. */
  #filled(name, fill, at = this.#engine.room(this.#engine.size_of(name))) {
    this.#engine.set_word(at, this.#engine.size_of(name));
    return this.#engine.check(fill(at)) ? this.#engine.struct(name, at) : null;
  }

  #hit(ask, at) {
    const hit = this.#filled('scree_hit', ask, at);
    return hit && { ...plain(hit), kind: KINDS_OF_HIT[hit.kind] };
  }
}

for (const name of REQUESTS)
  Client.prototype[name] = function request(given) { return this.request(name, given); };
