// One instance of scree_client.wasm: its memory, its structs by name, and the few functions that it imports. The layout of
// structs is made of scree/client.h by the build (layout.js). The memory moves when it grows: views of it hold until the next call.
import { structs, values } from './layout.js';

/** How numbers of a type are read and written in memory. */
function number_type(name, bytes) {
  const get = `get${name}`, set = `set${name}`;
  return { bytes, get: (memory, at) => memory[get](at, true), set: (memory, at, number) => memory[set](at, number, true) };
}
const TYPES = {
  int8: number_type('Int8', 1), uint8: number_type('Uint8', 1), int32: number_type('Int32', 4), uint32: number_type('Uint32', 4),
  float: number_type('Float32', 4), double: number_type('Float64', 8), int64: number_type('BigInt64', 8),
  uint64: number_type('BigUint64', 8), text: number_type('Uint32', 4), pointer: number_type('Uint32', 4),
};
/** Whole numbers that a member of that type can be. */
const WHOLE = { int8: [-128, 127], uint8: [0, 255], int32: [-(2 ** 31), 2 ** 31 - 1], uint32: [0, 2 ** 32 - 1] };
/** Of a block of memory: the most that a program of 32 bits can ask for. */
const BLOCK_MAX = 2 ** 31 - 1;
const encoder = new TextEncoder(), decoder = new TextDecoder();

/** What a refusal or an error is: `name` for programs, `message` for people. */
export class ScreeError extends Error {
  constructor(name, message) {
    super(message || name);
    this.name = name;
  }
}

const RESULTS = new Map([
  [values.SCREE_INVALID, 'invalid'], [values.SCREE_NOT_CONNECTED, 'not_connected'], [values.SCREE_NO_MEMORY, 'no_memory'],
  [values.SCREE_TOO_SMALL, 'too_small'], [values.SCREE_REFUSED, 'refused'],
]);

/** A whole number within bounds, or an error that names it. */
export function whole(number, [least, most], what) {
  if (!Number.isInteger(number) || number < least || number > most)
    throw new ScreeError('invalid', `${what} is a whole number from ${least} to ${most}`);
  return number;
}

/** What a program gave for a number of that type, in the form that memory takes. */
function number_for(type, given, what) {
  if (WHOLE[type]) return whole(given, WHOLE[type], what);
  if (type.endsWith('64')) {
    if (typeof given === 'bigint' || Number.isSafeInteger(given)) return BigInt(given);
    throw new ScreeError('invalid', `${what} is a whole number`);
  }
  if (typeof given !== 'number') throw new ScreeError('invalid', `${what} is a number`);
  return given;
}

/** By the name of a struct: what reads its members, each when it is asked for. Texts are read, 64 bits are BigInts, pointers are places. */
const VIEWS = {};
for (const [name, { members }] of Object.entries(structs)) {
  VIEWS[name] = class {
    constructor(engine, at) {
      this.engine = engine;
      this.at = at;
    }
  };
  VIEWS[name].prototype.names = Object.keys(members).filter((member) => !structs[members[member].type]);
  for (const member of VIEWS[name].prototype.names) {
    const { at: offset, type, count } = members[member];
    const { bytes, get } = TYPES[type];
    const one = type === 'text' ? (engine, at) => engine.text(get(engine.memory, at)) : (engine, at) => get(engine.memory, at);
    const read = count === 1 ? one : (engine, at) => Array.from({ length: count }, (_, i) => one(engine, at + i * bytes));
    Object.defineProperty(VIEWS[name].prototype, member, { get() { return read(this.engine, this.at + offset); } });
  }
}

/** What the module imports: a clock, random bytes, and where it would print before it ends. */
function imports(engine) {
  let words = '';
  const end = () => { throw new ScreeError('failed', words.trim() || 'the client has met an error of its own'); };
  return {
    clock_time_get(clock, _precision, at) {
      const now_ms = clock === 0 ? Date.now() : performance.now();
      engine.memory.setBigUint64(at, BigInt(Math.round(now_ms * 1e6)), true);
      return 0;
    },
    random_get(at, bytes) {
      globalThis.crypto.getRandomValues(engine.view(Uint8Array, at, bytes));
      return 0;
    },
    fd_write(_file, parts, count, written) {
      let total = 0;
      for (let i = 0; i < count; ++i) {
        const at = engine.word(parts + 8 * i), bytes = engine.word(parts + 8 * i + 4);
        words = (words + decoder.decode(engine.view(Uint8Array, at, bytes))).slice(-2000);
        total += bytes;
      }
      engine.set_word(written, total);
      return 0;
    },
    proc_exit: end,
    abort: end,
    __cxa_throw: end,
    emscripten_notify_memory_growth() {},
  };
}

export class Engine {
  /** Functions of the module: scree_… of scree/client.h, and those of the socket. */
  call;
  #memory = new DataView(new ArrayBuffer(0));
  #room = 0;        // memory for what a call takes and gives, of #room_bytes
  #room_bytes = 0;

  /** `module`: a WebAssembly.Module of scree_client.wasm. */
  static async create(module) {
    const engine = new Engine();
    const given = imports(engine);
    const wanted = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
      // What a system would have beside these is "not supported".
      (wanted[from] ??= {})[name] = given[name] ?? (from.startsWith('wasi_') ? () => 52 : given.abort);
    }
    engine.call = (await WebAssembly.instantiate(module, wanted)).exports;
    engine.call._initialize();
    return engine;
  }

  /** All memory. What grew has left its buffer without bytes. */
  get memory() {
    if (this.#memory.buffer.byteLength === 0) this.#memory = new DataView(this.call.memory.buffer);
    return this.#memory;
  }

  /** The numbers at a place, as a view that holds until the next call. */
  view(Type, at, count) {
    return new Type(this.memory.buffer, at, count);
  }

  /** A whole number of 32 bits. */
  word(at) {
    return this.memory.getUint32(at, true);
  }

  set_word(at, number) {
    this.memory.setUint32(at, number, true);
  }

  /** A copy of numbers; null at 0. */
  copy(Type, at, count) {
    return at === 0 ? new Type(0) : this.view(Type, at, count).slice();
  }

  text(at) {
    if (at === 0 || this.memory.getUint8(at) === 0) return '';
    const bytes = new Uint8Array(this.memory.buffer);
    return decoder.decode(bytes.subarray(at, bytes.indexOf(0, at)));
  }

  /** Memory for a call, aligned for any number. It holds until the next call of this. */
  room(bytes) {
    if (bytes <= this.#room_bytes) return this.#room;
    const wanted = Math.max(bytes, Math.min(2 * this.#room_bytes, BLOCK_MAX), 4096);
    const made = this.allocate(wanted); // before: what there was stays where there is no more
    this.call.free(this.#room);
    this.#room_bytes = wanted;
    this.#room = made;
    return made;
  }

  /** Memory that the caller frees: call.free(). */
  allocate(bytes) {
    if (!(bytes >= 0)) throw new ScreeError('invalid', 'a list has no length');
    const at = bytes > BLOCK_MAX ? 0 : this.call.malloc(Math.max(bytes, 1));
    if (at === 0) throw new ScreeError('no_memory', 'there is no memory');
    return at;
  }

  /** A struct's size, for its first member. */
  size_of(name) {
    return structs[name].size;
  }

  /** A struct: its members by name, read from memory when they are asked for, until the next call; `names` are all of them. */
  struct(name, at) {
    return new VIEWS[name](this, at);
  }

  /** Sets members of a struct. Texts go to `texts`, which frees them. */
  write(name, at, value, texts) {
    for (const [member, given] of Object.entries(value)) {
      const { at: offset, type, count } = structs[name].members[member];
      if (structs[type]) {
        this.write(type, at + offset, given, texts);
        continue;
      }
      const { bytes, set } = TYPES[type];
      const numbers = type === 'text' ? [texts.add(given)] : (count === 1 ? [given] : given).map((one) => number_for(type, one, member));
      for (let i = 0; i < count && i < numbers.length; ++i) set(this.memory, at + offset + i * bytes, numbers[i]);
    }
  }

  /** Throws what a result below 0 means; else whether there is something. */
  check(result) {
    if (result < 0) throw new ScreeError(RESULTS.get(result) ?? 'refused', this.text(this.call.scree_error()));
    return result === values.SCREE_OK;
  }

  /** Calls `work` with texts that live as long. */
  with_texts(work) {
    const made = [];
    const texts = {
      add: (text) => {
        if (text === null || text === undefined) return 0;
        if (String(text).includes('\0')) throw new ScreeError('invalid', 'a text has no character 0');
        const bytes = encoder.encode(String(text));
        const at = this.allocate(bytes.length + 1);
        made.push(at);
        const place = this.view(Uint8Array, at, bytes.length + 1);
        place.set(bytes);
        place[bytes.length] = 0;
        return at;
      },
    };
    try {
      return work(texts);
    } finally {
      for (const at of made) this.call.free(at);
    }
  }
}

/** In an engine's place once its client is over, so that its memory can go: whatever is asked of it is that error. */
export function no_engine(error) {
  return new Proxy({}, { get() { throw error; } });
}
