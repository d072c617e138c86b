// Stones that fill space: cells around points that lie unevenly on a lattice. For rubble and gravel. Needs noise.glsl.

struct Stone {
  vec3 off;    // from its middle, stones
  vec3 way;    // drawn for this stone, -0.5 to 0.5
  vec3 joint;  // unit, to the next stone
  float edge;  // to the face between the two, stones
};

vec3 drawn(ivec3 cell) {
  return vec3(lattice(cell), lattice(cell + ivec3(7919, 0, 0)), lattice(cell + ivec3(0, 7919, 0))) - 0.5;
}

// `q` in stones: about one of them a unit.
Stone stone_at(vec3 q) {
  ivec3 base = ivec3(floor(q - 0.5));
  vec3 first = vec3(0.0), second = vec3(0.0), way = vec3(0.0);
  float least = 1e9, next = 1e9;
  for (int i = 0; i < 8; ++i) {
    ivec3 cell = base + ivec3(i >> 2, (i >> 1) & 1, i & 1);
    vec3 draw = drawn(cell);
    vec3 middle = vec3(cell) + 0.5 + 0.72 * draw;
    vec3 off = middle - q;
    float far = dot(off, off);
    if (far < least) {
      next = least;
      second = first;
      least = far;
      first = off;
      way = draw;
    } else if (far < next) {
      next = far;
      second = off;
    }
  }
  vec3 across = second - first;
  Stone stone;
  stone.off = -first;
  stone.way = way.zxy;
  stone.joint = across / max(length(across), 1e-4);
  stone.edge = dot(0.5 * (first + second), stone.joint);
  return stone;
}
