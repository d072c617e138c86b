// Meshes as typed arrays of their own, copied out of the engine's memory.
import { ScreeError, no_engine } from './engine.js';
import { triple } from './requests.js';
import { values } from './layout.js';

const METHODS = ['nets', 'dual', 'cubes'];

/** The mesh at a place of the engine's memory. */
export function mesh_at(engine, at) {
  const mesh = engine.struct('scree_mesh', at);
  const vertices = mesh.vertex_count;
  return {
    kind: ['terrain', 'piece', 'prop'][mesh.kind],
    id: mesh.id,
    level: mesh.level,
    node: mesh.node,
    origin: mesh.origin_m,
    gone: (mesh.flags & 1) !== 0,
    positions: engine.copy(Float32Array, mesh.positions, 3 * vertices),
    normals: engine.copy(Float32Array, mesh.normals, 3 * vertices),
    materials: engine.copy(Uint8Array, mesh.materials, vertices),
    shades: engine.copy(Uint8Array, mesh.shades, vertices),
    indices: engine.copy(Uint32Array, mesh.indices, mesh.index_count),
  };
}

/** Makes one mesh by a function that fills a struct; null: there is no surface. */
export function single_mesh(engine, client, make) {
  const bytes = engine.size_of('scree_mesh');
  const at = engine.room(bytes + 12);
  engine.view(Uint8Array, at, bytes).fill(0);
  engine.set_word(at, bytes);
  if (!engine.check(make(at, at + bytes))) return null;
  try {
    return mesh_at(engine, at);
  } finally {
    engine.call.scree_mesh_release(client, at);
  }
}

export class Mesher {
  #engine;
  #mesher;
  #left;

  /** `left` is called when it is closed. */
  constructor(engine, client, { radius = 0, method = 'nets', rounded = false }, left) {
    const bytes = engine.size_of('scree_mesher_options');
    const at = engine.room(bytes + 4);
    engine.check(engine.call.scree_mesher_options_init(at, bytes));
    const members = { radius_m: radius, method: METHODS.indexOf(method) >>> 0, rounded: rounded ? 1 : 0 };
    engine.with_texts((texts) => engine.write('scree_mesher_options', at, members, texts));
    engine.check(engine.call.scree_mesher_create(client, at, at + bytes));
    this.#engine = engine;
    this.#mesher = engine.word(at + bytes);
    this.#left = left;
  }

  update(eye, milliseconds = 4) {
    const until = performance.now() + milliseconds;
    const meshes = [];
    const place = triple(eye, 'the eye');
    do {
      const at = this.#engine.room(12);
      this.#engine.view(Float32Array, at, 3).set(place);
      if (this.#engine.check(this.#engine.call.scree_mesher_update(this.#mesher, at))) this.#take(meshes);
    } while (performance.now() < until && !this.complete);
    return meshes;
  }

  /** All meshes of an update. */
  #take(meshes) {
    const bytes = this.#engine.size_of('scree_mesh');
    const at = this.#engine.room(bytes);
    this.#engine.set_word(at, bytes);
    while (this.#engine.check(this.#engine.call.scree_mesher_next(this.#mesher, at))) meshes.push(mesh_at(this.#engine, at));
  }

  get complete() {
    const at = this.#engine.room(4);
    this.#engine.check(this.#engine.call.scree_mesher_complete(this.#mesher, at));
    return this.#engine.word(at) === 1;
  }

  close() {
    if (this.#mesher === 0) return;
    this.#engine.call.scree_mesher_destroy(this.#mesher);
    this.forget(new ScreeError('closed', 'the mesher is closed'));
  }

  /** The engine has destroyed it, or does so with its client. */
  forget(error) {
    this.#mesher = 0;
    this.#engine = no_engine(error);
    this.#left(this);
  }
}

/** By names, all of which are asked for where a program names none. */
const MASKS = { terrain: values.SCREE_MASK_TERRAIN, pieces: values.SCREE_MASK_PIECES, bodies: values.SCREE_MASK_BODIES };
export function mask_of(names = Object.keys(MASKS)) {
  if (!Array.isArray(names) || !names.every((name) => Object.hasOwn(MASKS, name)))
    throw new ScreeError('invalid', `\`of\` is a list of ${Object.keys(MASKS).join(', ')}`);
  return names.reduce((mask, name) => mask | MASKS[name], 0);
}
