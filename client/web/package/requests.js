// From what a program says of a request to the struct of the engine. A kind is a row.
import { ScreeError, whole } from './engine.js';
import { enums, values } from './layout.js';

const SHAPES = { sphere: values.SCREE_SPHERE, box: values.SCREE_BOX, capsule: values.SCREE_CAPSULE, crater: values.SCREE_CRATER };
/** No world has voxels beyond. */
const CELL_MAX = 2 ** 20;
const MOTIONS = ['dynamic', 'kinematic', 'fixed'];

/** Three numbers of an array, a typed array, or an object with x, y and z. */
export function triple(place, what) {
  const is_list = typeof place?.length === 'number'; // of a vector of three.js it is a function
  const [x, y, z] = is_list ? place : [place?.x, place?.y, place?.z];
  if ((is_list && place.length !== 3) || ![x, y, z].every((number) => typeof number === 'number'))
    throw new ScreeError('invalid', `${what} is three numbers`);
  return [x, y, z];
}

/** Three whole numbers that name a voxel or a chunk. */
export function cell(place, what) {
  return triple(place, what).map((number) => whole(number, [-CELL_MAX, CELL_MAX], what));
}

function rotation(turn = [0, 0, 0, 1]) {
  const [x, y, z, w] = typeof turn.length === 'number' ? turn : [turn.x, turn.y, turn.z, turn.w];
  return [x, y, z, w];
}

function shape_of(given) {
  const kind = given.shape ?? 'sphere';
  if (!Object.hasOwn(SHAPES, kind)) throw new ScreeError('invalid', `there is no shape "${kind}"`);
  const shape = { kind: SHAPES[kind], radius_m: given.radius ?? 0 };
  if (kind === 'capsule') return { ...shape, a_m: triple(given.from, 'from'), b_m: triple(given.to, 'to') };
  shape.a_m = triple(given.centre, 'centre');
  if (kind === 'box') shape.b_m = triple(given.half, 'half');
  return shape;
}

/** The middle of a shape, where a blow that nobody places has its place. */
function middle_of({ a_m, b_m, kind }) {
  return kind === SHAPES.capsule ? a_m.map((x, i) => (x + b_m[i]) / 2) : a_m;
}

/** Members that a program has said; the others keep what scree_request_init() has set. */
const said = (members) => Object.fromEntries(Object.entries(members).filter(([, value]) => value !== undefined));

const piece_or_shape = (given) => (given.piece === undefined ? { shape: shape_of(given) } : { body: given.piece });

/** By name: the kind, and its members. `look_up` has numbers of materials and patterns. */
const ROWS = {
  carve: [values.SCREE_CARVE, (given, look_up) => {
    const shape = shape_of(given);
    return { shape, pattern: look_up.pattern(given.pattern), seeds: given.seeds, random_seed: given.randomSeed,
      place_m: given.impact ? triple(given.impact, 'impact') : middle_of(shape), speed_m_s: given.speed, body: given.piece };
  }],
  fill: [values.SCREE_FILL, (given, look_up) => ({ shape: shape_of(given), material: look_up.material(given.material) })],
  paint: [values.SCREE_PAINT, (given, look_up) => ({ shape: shape_of(given), material: look_up.material(given.material) })],
  blast: [values.SCREE_BLAST, (given) =>
    ({ place_m: triple(given.centre, 'centre'), energy_j: given.energy, random_seed: given.randomSeed })],
  dig: [values.SCREE_DIG, piece_or_shape],
  place: [values.SCREE_PLACE, (given, look_up) =>
    ({ shape: shape_of(given), material: look_up.material(given.material), flags: given.solid ? 1 : 0 })],
  cutOut: [values.SCREE_CUT_OUT, (given) => ({ shape: shape_of(given) })],
  release: [values.SCREE_RELEASE, (given) => ({ body: given.piece })],
  breakPiece: [values.SCREE_BREAK, (given) =>
    ({ body: given.piece, place_m: triple(given.at, 'at'), seeds: given.seeds, random_seed: given.randomSeed })],
  push: [values.SCREE_PUSH, (given) =>
    ({ body: given.body, place_m: triple(given.at, 'at'), vector: triple(given.impulse, 'impulse') })],
  addBody: [values.SCREE_ADD_BODY, (given, look_up) => ({
    shape: shape_of({ centre: [0, 0, 0], ...given }), place_m: triple(given.position, 'position'), rotation: rotation(given.rotation),
    vector: triple(given.velocity ?? [0, 0, 0], 'velocity'), mass_kg: given.mass, material: look_up.material(given.material),
    motion: look_up.motion(given.motion), tag: given.tag ?? 0,
  })],
  removeBody: [values.SCREE_REMOVE_BODY, (given) => ({ body: given.body })],
  moveBody: [values.SCREE_MOVE_BODY, (given) => ({
    body: given.body, place_m: triple(given.position, 'position'), rotation: rotation(given.rotation),
    vector: triple(given.velocity ?? [0, 0, 0], 'velocity'),
  })],
  stand: [values.SCREE_STAND, (given) => ({ flags: given.leave ? 1 : 0 })],
  give: [values.SCREE_GIVE, () => ({})],
};

const TAKEN = new Set(Object.values(ROWS).map(([kind]) => kind));
for (const [name, kind] of Object.entries(enums.scree_request_kind))
  if (!TAKEN.has(kind)) throw new Error(`the package has no request ${name}`);

/** Names of all requests: the methods of a client. */
export const REQUESTS = Object.keys(ROWS);

/** Sends a request; returns its number. */
export function send_request(engine, client, name, given, look_up) {
  if (given === null || typeof given !== 'object') throw new ScreeError('invalid', `${name} takes an object`);
  const [kind, members_of] = ROWS[name];
  const motion = (word) => {
    if (word === undefined) return undefined;
    if (!MOTIONS.includes(word)) throw new ScreeError('invalid', `a motion is ${MOTIONS.join(', ')}`);
    return MOTIONS.indexOf(word);
  };
  const members = said(members_of(given, { ...look_up, motion }));
  const bytes = engine.size_of('scree_request');
  const at = engine.room(bytes + 8), number = at + bytes;
  engine.check(engine.call.scree_request_init(at, bytes, kind));
  engine.with_texts((texts) => engine.write('scree_request', at, members, texts));
  engine.check(engine.call.scree_client_request(client, at, 0, 0, number));
  return engine.word(number);
}
