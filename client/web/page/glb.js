// Models of props: binary glTF 2.0, by the rules of content/model/glb.h, whose words say more. The bytes are hostile: each
// access is checked, and what is wrong throws. scree.wasm checks the result once more.

const BYTES_MAX = 4 << 20, JSON_MAX = 1 << 20, VERTICES_MAX = 1 << 17, TRIANGLES_MAX = 1 << 17, NODES_MAX = 4096, NUMBER_MAX = 1e6;
/** Bytes of a vertex: a place of three floats, a normal and a colour of four bytes each. */
const VERTEX = 20;
const SIZES = { 5121: 1, 5123: 2, 5125: 4, 5126: 4 };
const COLUMNS = { SCALAR: 1, VEC3: 3, VEC4: 4 };

function must(holds, words) { if (!holds) throw new Error(words); }
function is_whole(value, most = BYTES_MAX) { return Number.isInteger(value) && value >= 0 && value <= most; }
function whole(value, otherwise) {
  const number = value === undefined ? otherwise : value;
  must(is_whole(number), 'its JSON lacks a whole number, or has one out of bounds');
  return number;
}
function numbers(list, count, otherwise) {
  if (list === undefined) return otherwise;
  must(Array.isArray(list) && list.length === count && list.every((value) => Math.abs(value) <= NUMBER_MAX && typeof value === 'number'),
    'its JSON has what is no list of numbers, or out of bounds');
  return list;
}
function element(list, number) {
  must(Array.isArray(list) && is_whole(number) && typeof list[number] === 'object' && list[number], 'its JSON names what it lacks');
  return list[number];
}

function head_of(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  const word = (at) => view.getUint32(at, true);
  must(bytes.length <= BYTES_MAX, 'it is too large');
  must(bytes.length >= 20 && word(0) === 0x46546c67 && word(4) === 2, 'it is no binary glTF 2');
  const size = word(12), end = 20 + size;
  must(word(8) <= bytes.length && word(16) === 0x4e4f534a && end <= bytes.length, 'it is cut short');
  must(size <= JSON_MAX, 'its JSON is too large');
  const json = JSON.parse(new TextDecoder('utf-8', { fatal: true }).decode(bytes.subarray(20, end)));
  must(json && typeof json === 'object', 'its JSON is damaged');
  if (bytes.length < end + 8 || word(end + 4) !== 0x004e4942) return { json, view, begin: end, length: 0 };
  must(word(end) <= bytes.length - end - 8, 'its buffer is cut short');
  return { json, view, begin: end + 8, length: word(end) };
}

/** Columns of a 4 × 4 matrix, each after the other. */
function product(a, b) {
  return Array.from({ length: 16 }, (_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[k * 4 + i % 4] * b[(i & 12) + k], 0));
}
function transform_of(node) {
  if (node.matrix !== undefined) return numbers(node.matrix, 16);
  const [tx, ty, tz] = numbers(node.translation, 3, [0, 0, 0]), [sx, sy, sz] = numbers(node.scale, 3, [1, 1, 1]);
  const [x, y, z, w] = numbers(node.rotation, 4, [0, 0, 0, 1]);
  return [(1 - 2 * (y * y + z * z)) * sx, 2 * (x * y + z * w) * sx, 2 * (x * z - y * w) * sx, 0,
    2 * (x * y - z * w) * sy, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z + x * w) * sy, 0,
    2 * (x * z + y * w) * sz, 2 * (y * z - x * w) * sz, (1 - 2 * (x * x + y * y)) * sz, 0, tx, ty, tz, 1];
}
const cross = (m, i, j) => [m[i + 1] * m[j + 2] - m[i + 2] * m[j + 1], m[i + 2] * m[j] - m[i] * m[j + 2], m[i] * m[j + 1] - m[i + 1] * m[j]];

class Reader {
  #head; #vertices = []; #corners = []; #count = 0;

  constructor(head) { this.#head = head; }

  /** What an accessor has: `at(i, column)`, bytes and shorts as parts of their largest; and `index(i)`. */
  #accessor(number) {
    const { json, view, begin, length } = this.#head;
    const from = element(json.accessors, number), part = element(json.bufferViews, from.bufferView);
    must(from.sparse === undefined && part.buffer === 0, 'it has a sparse accessor, or another buffer than its own');
    const type = from.componentType, columns = Object.hasOwn(COLUMNS, from.type) ? COLUMNS[from.type] : 0;
    must(Object.hasOwn(SIZES, type) && columns, 'it has an accessor of another type');
    const count = whole(from.count), size = columns * SIZES[type], stride = whole(part.byteStride, size);
    const first = whole(part.byteOffset, 0), offset = whole(from.byteOffset, 0), bytes = whole(part.byteLength);
    must(count && stride >= size && first + bytes <= length && offset + stride * (count - 1) + size <= bytes,
      'it has an accessor beyond its buffer');
    const place = begin + first + offset;
    const read = { 5121: (at) => view.getUint8(at), 5123: (at) => view.getUint16(at, true), 5125: (at) => view.getUint32(at, true),
      5126: (at) => view.getFloat32(at, true) }[type];
    const most = { 5121: 255, 5123: 65535 }[type] ?? 1;
    return { count, columns, type, index: (i) => read(place + i * stride), at: (i, c) => read(place + i * stride + c * SIZES[type]) / most };
  }

  #add_vertices(attributes, colour, m) {
    const of = (name) => (attributes[name] === undefined ? null : this.#accessor(attributes[name]));
    const places = this.#accessor(attributes.POSITION), normals = of('NORMAL'), colours = of('COLOR_0'), count = places.count;
    must(places.columns === 3 && places.type === 5126, 'it has positions that are no vectors of floats');
    must(!normals || (normals.columns === 3 && normals.type === 5126 && normals.count === count), 'it has normals that are no vectors of floats');
    must(!colours || (colours.columns >= 3 && colours.type !== 5125 && colours.count === count), 'it has colours that are no vectors');
    must((this.#count += count) <= VERTICES_MAX, 'it has too many vertices');
    // Normals go by the matrix of cofactors.
    const upright = [...cross(m, 4, 8), ...cross(m, 8, 0), ...cross(m, 0, 4)];
    const side = m[0] * upright[0] + m[1] * upright[1] + m[2] * upright[2] < 0 ? -1 : 1;
    const made = new DataView(new ArrayBuffer(count * VERTEX));
    for (let i = 0; i < count; ++i) {
      const turned = (of_what, by, row) => [0, 1, 2].reduce((sum, k) => sum + by[k * (by.length === 9 ? 3 : 4) + row] * of_what.at(i, k), 0);
      const normal = normals ? [0, 1, 2].map((row) => side * turned(normals, upright, row)) : [0, 0, 0];
      const long = Math.hypot(...normal);
      for (let c = 0; c < 3; ++c) {
        made.setFloat32(i * VERTEX + 4 * c, turned(places, m, c) + m[12 + c], true);
        if (long > 1e-12 && long < 1e12) made.setInt8(i * VERTEX + 12 + c, Math.round(normal[c] / long * 127));
        const light = colour[c] * (colours ? colours.at(i, c) : 1);
        made.setUint8(i * VERTEX + 16 + c, light > 0 ? Math.floor(Math.sqrt(Math.min(light, 1)) * 255 + 0.5) : 0);
      }
    }
    this.#vertices.push(made);
    return { count, mirrored: side < 0 };
  }

  #add_primitive(primitive, m) {
    must((primitive.mode ?? 4) === 4, 'it has other primitives than triangles');
    must(primitive.attributes && typeof primitive.attributes === 'object', 'it has a primitive without attributes');
    const looks = primitive.material === undefined ? null : element(this.#head.json.materials, primitive.material).pbrMetallicRoughness;
    const first = this.#count, colour = numbers(looks?.baseColorFactor, 4, [1, 1, 1, 1]);
    const { count, mirrored } = this.#add_vertices(primitive.attributes, colour, m);
    const indices = primitive.indices === undefined ? null : this.#accessor(primitive.indices);
    must(!indices || (indices.columns === 1 && indices.type !== 5126), 'it has indices that are no whole numbers');
    const corners = indices ? indices.count : count;
    must(corners % 3 === 0 && this.#corners.length + corners <= 3 * TRIANGLES_MAX, 'it has no whole triangles, or too many');
    for (let i = 0; i < corners; ++i) {
      const other = mirrored && i % 3 < 2 ? i + 1 - 2 * (i % 3) : i, index = indices ? indices.index(other) : other;
      must(index < count, 'it has an index without its vertex');
      this.#corners.push(first + index);
    }
  }

  /** Two numbers of 32 bits, of vertices and of corners; the vertices; the corners, three a triangle. */
  read() {
    const { json } = this.#head;
    const demands = json.extensionsRequired ?? [];
    must(Array.isArray(demands) && demands.every((name) => String(name).startsWith('KHR_materials_')), 'it needs an extension that is not read here');
    must(json.buffers?.[0]?.uri === undefined, 'its buffer lies in another file, which is never read');
    const visits = [], met = new Set();
    const visit = (nodes, above) => {
      must(Array.isArray(nodes), 'it has nodes that are no list');
      for (const node of nodes) visits.push([node, above]);
    };
    visit(element(json.scenes, whole(json.scene, 0)).nodes, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    while (visits.length) {
      const [number, above] = visits.pop();
      must(is_whole(number, NODES_MAX - 1) && !met.has(number), 'it has too many nodes, or they are no tree');
      met.add(number);
      const node = element(json.nodes, number), transform = product(above, transform_of(node));
      if (node.mesh !== undefined) for (const primitive of element(json.meshes, node.mesh).primitives) this.#add_primitive(primitive, transform);
      if (node.children !== undefined) visit(node.children, transform);
    }
    const bytes = new Uint8Array(8 + this.#count * VERTEX + this.#corners.length * 4);
    new Uint32Array(bytes.buffer, 0, 2).set([this.#count, this.#corners.length]);
    let at = 8;
    for (const part of this.#vertices) {
      bytes.set(new Uint8Array(part.buffer), at);
      at += part.byteLength;
    }
    new Uint32Array(bytes.buffer, at).set(this.#corners);
    return bytes;
  }
}

/** Throws what is wrong with the file. */
export function read_glb(bytes) { return new Reader(head_of(bytes)).read(); }

/** Null: the file is said to be bad, and the parts of its props are drawn. */
export function read_model(bytes) {
  try {
    return read_glb(bytes);
  } catch (error) {
    console.warn(`The model of a prop cannot be shown: ${error.message}`);
    return null;
  }
}
