// One instance of scree_client.wasm: its memory, its structs by name, and the few functions that it imports. The layout of
// structs is made of scree/client.h by the build (layout.js). Nothing here keeps a view of the memory: it moves when it grows.
import { structs, values } from './layout.js';

const NUMBER_OF = {
  int8: [Int8Array, 1], uint8: [Uint8Array, 1], int32: [Int32Array, 4], uint32: [Uint32Array, 4],
  float: [Float32Array, 4], double: [Float64Array, 8], int64: [BigInt64Array, 8], uint64: [BigUint64Array, 8],
  text: [Uint32Array, 4], pointer: [Uint32Array, 4],
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

/** What the module imports: a clock, random bytes, and where it would print before it ends. */
function imports(memory_of) {
  const view = () => new DataView(memory_of().buffer);
  let words = '';
  const end = () => { throw new ScreeError('failed', words.trim() || 'the client has met an error of its own'); };
  return {
    clock_time_get(clock, _precision, at) {
      const now_ms = clock === 0 ? Date.now() : performance.now();
      view().setBigUint64(at, BigInt(Math.round(now_ms * 1e6)), true);
      return 0;
    },
    random_get(at, bytes) {
      globalThis.crypto.getRandomValues(new Uint8Array(memory_of().buffer, at, bytes));
      return 0;
    },
    fd_write(_file, parts, count, written) {
      let total = 0;
      for (let i = 0; i < count; ++i) {
        const at = view().getUint32(parts + 8 * i, true), bytes = view().getUint32(parts + 8 * i + 4, true);
        words = (words + decoder.decode(new Uint8Array(memory_of().buffer, at, bytes))).slice(-2000);
        total += bytes;
      }
      view().setUint32(written, total, true);
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
  #room = 0;        // memory for what a call takes and gives, of #room_bytes
  #room_bytes = 0;

  /** `module`: a WebAssembly.Module of scree_client.wasm. */
  static async create(module) {
    const engine = new Engine();
    const given = imports(() => engine.call.memory);
    const wanted = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
      // What a system would have beside these is "not supported".
      (wanted[from] ??= {})[name] = given[name] ?? (from.startsWith('wasi_') ? () => 52 : given.abort);
    }
    engine.call = (await WebAssembly.instantiate(module, wanted)).exports;
    engine.call._initialize();
    return engine;
  }

  /** The numbers at a place, as a view that holds until the next call. */
  view(Type, at, count) {
    return new Type(this.call.memory.buffer, at, count);
  }

  /** A copy of numbers; null at 0. */
  copy(Type, at, count) {
    return at === 0 ? new Type(0) : this.view(Type, at, count).slice();
  }

  text(at) {
    if (at === 0) return '';
    const bytes = new Uint8Array(this.call.memory.buffer);
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

  /** A struct as an object with its members' names; texts are read, 64 bits are BigInts, pointers are places. */
  read(name, at) {
    const value = {};
    for (const [member, { at: offset, type, count }] of Object.entries(structs[name].members)) {
      const [Type] = NUMBER_OF[type];
      const numbers = this.view(Type, at + offset, count);
      if (type === 'text') value[member] = this.text(numbers[0]);
      else value[member] = count === 1 ? numbers[0] : Array.from(numbers);
    }
    return value;
  }

  /** Sets members of a struct. Texts go to `texts`, which frees them. */
  write(name, at, value, texts) {
    for (const [member, given] of Object.entries(value)) {
      const { at: offset, type, count } = structs[name].members[member];
      if (structs[type]) {
        this.write(type, at + offset, given, texts);
        continue;
      }
      const [Type] = NUMBER_OF[type];
      const numbers = type === 'text' ? [texts.add(given)] : (count === 1 ? [given] : given).map((one) => number_for(type, one, member));
      this.view(Type, at + offset, count).set(numbers);
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
