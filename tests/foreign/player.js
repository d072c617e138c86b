// A session of a person as promises: requests with their replies, what the server says of persons, stores and regions, and
// inputs on foot at the pace of the server. Terrain and bodies are mirrored in `world`, whose hashes are checked.
import { setTimeout as sleep } from 'node:timers/promises';

import { Connection } from './connection.js';
import { Game } from './game.js';
import { unpackStoreMasses } from './packed.js';
import { World, bigOf } from './world.js';

const PROTOCOL = 6;
export const WALKS_M_S = 4;
const WAIT_MS = 30000;
const INPUTS_UNDER_WAY_MAX = 12; // the server saves rights for as many, and lets 16 wait
const FIRST_REQUEST = 1 << 30; // a refused input is answered by its number: those of requests are others

/** An act of rules is packed bytes (rules.proto), its number first. */
const numbered = (request, act) => {
  const number = [];
  for (let left = request; ; left >>>= 7) {
    number.push(left > 0x7f ? (left & 0x7f) | 0x80 : left);
    if (left <= 0x7f) return Buffer.concat([Buffer.from([0x08, ...number]), act]);
  }
};

export class Player {
  world = new World();
  welcome = null;
  persons = new Map(); // who is on foot: the body's id by session
  own = null; // OwnPerson, as it was told last
  stores = null; // the last message, parsed: [{kind, number, masses}]
  regions = []; // as they came last
  game = new Game(); // what the server's rules show and tell
  status = null;
  refusedInputs = new Map(); // the name of the refusal, by number
  #input = 0;
  #request = FIRST_REQUEST;
  #answers = new Map(); // by number of a request: what resolves it
  #waiting = new Set(); // {holds, resolve, reject}

  /** Resolves when the server has let it in. */
  static async join({ name, port, proto, token, eye, radius = 48 }) {
    const player = new Player(name, port, proto);
    player.radius = radius;
    player.send('hello', {
      protocol: PROTOCOL,
      client: Buffer.from('foreign person'),
      token: Buffer.from(token),
      eye,
      at_spawn: eye === undefined,
      interest_radius_m: radius,
      lacks_kernels: true,
    });
    await player.until('a welcome', () => player.welcome);
    return player;
  }

  constructor(name, port, proto) {
    this.name = name;
    const onMessage = (kind, message) => this.#receive(kind, message);
    this.connection = new Connection({ host: '127.0.0.1', port, proto, onMessage, onEnd: (why) => this.#fail(why) });
  }

  get session() {
    return this.welcome.session.toString();
  }

  get feet() {
    const { x, y, z } = this.own.feet;
    return { x, y, z };
  }

  send(kind, content) {
    this.connection.send(kind, content);
  }

  /** A message to the server's rules; a server without rules skips it. */
  tell(channel, data) {
    this.send('channel', { channel: Buffer.from(channel), data: Buffer.from(data) });
  }

  leave() {
    this.connection.onEnd = null;
    this.send('goodbye', {});
  }

  /** Resolves to the first value of `holds()` that is not falsy, looked for after each message. */
  async until(what, holds) {
    const now = holds();
    if (now) return now;
    const waiter = { holds };
    const found = new Promise((resolve, reject) => Object.assign(waiter, { resolve, reject }));
    this.#waiting.add(waiter);
    const late = setTimeout(() => waiter.reject(new Error(`${this.name} waited in vain for ${what}`)), WAIT_MS);
    return found.finally(() => (clearTimeout(late), this.#waiting.delete(waiter)));
  }

  // ---- requests

  /** Resolves to the Reply, or the AdminList: refused or not. */
  async ask(kind, content) {
    const request = ++this.#request;
    let answer = null;
    this.#answers.set(request, (message) => (answer = message));
    this.send(kind, kind === 'rules' ? numbered(request, content) : { request, ...content });
    return this.until(`the answer to ${kind}`, () => answer);
  }

  /** A request that is carried out: resolves to the Reply. */
  async demand(kind, content) {
    const reply = await this.ask(kind, content);
    if (reply.refusal?.length > 0) throw new Error(`${this.name}: ${kind}: ${reply.refusal_name}: ${reply.refusal}`);
    return reply;
  }

  /** A request that is refused by this name: resolves to the words. */
  async refused(name, kind, content) {
    const reply = await this.ask(kind, content);
    const got = Buffer.from(reply.refusal_name).toString();
    if (got !== name) throw new Error(`${this.name}: ${kind} was answered by '${got}' in place of '${name}'`);
    return Buffer.from(reply.refusal).toString();
  }

  async question(question) {
    const query = ++this.#request;
    let answer = null;
    this.#answers.set(query, (message) => (answer = message));
    this.send('query', { query, questions: [question] });
    return (await this.until('an answer', () => answer)).answers[0];
  }

  // ---- on foot

  /** Enters on foot. Resolves to the id of its body, which the server has told of. */
  async stand(content = {}) {
    const { prop } = await this.demand('stand', content);
    await this.until('its place on foot', () => this.persons.get(this.session) === prop && this.own);
    return prop;
  }

  /** One input; others than the next number are for tries. Returns the number. */
  input(content, number = this.#input + 1) {
    if (number === this.#input + 1) this.#input = number;
    this.send('walk', { number, look: { z: -1 }, ...content });
    return number;
  }

  /** An input for each tick that passes. Resolves to OwnPerson when the server has taken the last one. */
  async walk(ticks, content) {
    const tick_ms = 1000 / this.welcome.tick_rate_hz;
    this.#input = this.own.taken; // refused ones before it do not count
    this.refusedInputs.clear();
    for (let sent = 0, next = performance.now(); sent < ticks; await sleep(tick_ms / 2)) {
      const now = performance.now();
      for (; sent < ticks && next <= now && this.#input - this.own.taken < INPUTS_UNDER_WAY_MAX; sent++, next += tick_ms)
        this.input(content);
      next = Math.max(next, now - 10 * tick_ms);
    }
    const own = await this.until('its last input to be taken', () => this.own.taken === this.#input && this.own);
    for (const [number, name] of this.refusedInputs) throw new Error(`${this.name}: input ${number}: ${name}`);
    this.look(this.feet);
    return own;
  }

  /** Walks on the shortest way until it is less than `near_m` from there, over the ground. */
  async walkTo({ x, z }, near_m) {
    for (let tries = 0; tries < 20; tries++) {
      const [dx, dz] = [x - this.own.feet.x, z - this.own.feet.z];
      const left_m = Math.hypot(dx, dz) - near_m;
      if (left_m <= 0) return;
      const ticks = Math.ceil((left_m / WALKS_M_S) * this.welcome.tick_rate_hz) + 10;
      await this.walk(ticks, { x: dx / Math.hypot(dx, dz), z: dz / Math.hypot(dx, dz) });
    }
    throw new Error(`${this.name} does not get there`);
  }

  look(eye) {
    this.send('interest', { eye, radius_m: this.radius });
  }

  // ---- what comes

  #receive(kind, message) {
    const handlers = {
      welcome: () => (this.welcome = message),
      refusal: () => this.#fail(`refused: ${message.reason}`),
      frame: () => this.world.frame(message),
      chunk: () => this.world.chunk(message),
      piece: () => this.world.piece(message),
      prop: () => this.world.prop(message),
      reset: () => ((this.game.signs = []), this.world.reset()),
      reply: () => this.#answered(message),
      admin_list: () => this.#answered(message),
      answer: () => this.#answered({ ...message, request: message.query }),
      status: () => (this.status = message),
      stores: () => (this.stores = message.stores.map(unpackStore)),
      regions: () => (this.regions = message.regions),
      person_places: () => this.#personPlaces(message),
    };
    if (!this.game.receive(kind, message)) handlers[kind]?.();
    if (this.world.mismatched) this.#fail(`a check of tick ${this.world.mismatched.tick} failed`);
    for (const waiter of this.#waiting) {
      const value = waiter.holds();
      if (value) waiter.resolve(value);
    }
  }

  #answered(message) {
    if (message.request < FIRST_REQUEST) return void this.refusedInputs.set(message.request, `${message.refusal_name}`);
    this.#answers.get(message.request)(message);
    this.#answers.delete(message.request);
  }

  #personPlaces({ listed, persons, own }) {
    if (listed) this.persons = new Map(persons.map(({ session, body }) => [session.toString(), body]));
    if (own) this.own = own;
    if (!this.persons.has(this.session)) this.own = null;
  }

  #fail(why) {
    const error = new Error(`${this.name}: ${why}`);
    if (this.#waiting.size === 0) throw error;
    for (const { reject } of this.#waiting) reject(error);
  }
}

/** A Store as {kind, number, name, masses}: the mass by row of the palette. */
export function unpackStore({ store, masses }) {
  return { kind: store.kind, number: bigOf(store.number), name: `${store.name}`, masses: unpackStoreMasses(masses) };
}

export const sumOf = (masses) => [...masses.values()].reduce((a, b) => a + b, 0n);
