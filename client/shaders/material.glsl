// What the rows of the palette look like (client/render/gl/material_table.h), in the frame of the rock: patterns fill
// space, so a broken face shows what was inside, and a piece keeps its pattern while it moves. Needs stones.glsl.
// SURFACES, which the program defines, says what it must know (client/render/gl/surface_variants.h).

struct Rock {
  vec3 albedo;
  vec3 normal;      // bent by the grain
  float open;       // 1, less in a crack
  float roughness;  // 1: dull
};

#if SURFACES > 0

uniform highp sampler2D u_materials;

// What was made as it is, such as a barrel, has no broken faces, whichever way it looks.
bool is_whole = false;

// As shared/material/palette.h numbers them.
const int pattern_grain = 1;
const int pattern_strata = 2;
const int pattern_bricks = 3;
const int pattern_planks = 4;
const int pattern_pebbles = 5;

bool is_rubble(int look) { return texelFetch(u_materials, ivec2(look - 1, 1), 0).w > 0.5; }

// What a pattern makes of a place: `shade` times the colour, slopes that bend the normal, how open it is.
struct Marks {
  vec3 shade;
  vec3 bump;
  float open;
};

// 1 in a joint whose middle is `edge` away, 0 beyond half its width. A pixel that covers much of it blurs it.
float joint_at(float edge, float half_width, float pixel) {
  float soft = max(0.35 * half_width, pixel);
  return (1.0 - smoothstep(half_width - 0.5 * soft, half_width + 0.5 * soft, edge)) * min(1.0, 2.0 * half_width / soft);
}

// The face that a surface has: x along it, y up or across it, z into it.
vec3 on_face(vec3 p, vec3 n) {
  vec3 a = abs(n);
  if (a.y > a.x && a.y > a.z) return p.xzy;
  return a.x > a.z ? p.zyx : p;
}
vec3 off_face(vec3 slope, vec3 n) {
  vec3 a = abs(n);
  if (a.y > a.x && a.y > a.z) return slope.xzy;
  return a.x > a.z ? slope.zyx : slope;
}

// Courses in a running bond, mortar between them. A broken brick is brighter inside, and each breaks by itself.
Marks bricks_at(vec3 p, vec3 n, float size, float broken, float pixel, float fine) {
  vec3 q = on_face(p, n);
  vec3 side = vec3(size, 0.30 * size, 0.5 * size);
  bool flat_face = abs(n.y) > max(abs(n.x), abs(n.z));
  if (flat_face) side.yz = side.zy;
  float course = floor(q.y / side.y);
  q.x += 0.5 * side.x * mod(course, 2.0);
  vec3 at = q / side;
  ivec3 cell = ivec3(floor(at));
  vec3 off = (fract(at) - 0.5) * side;  // from the brick's middle, metres
  vec3 edge = 0.5 * side - abs(off);
  vec3 draw = drawn(ivec3(cell.xy, broken > 0.5 ? cell.z : 0));
  float width = 0.022 * size;
  float mortar = max(joint_at(edge.x, width, pixel), joint_at(edge.y, width, pixel));
  mortar = max(mortar, broken * joint_at(edge.z, width, pixel));
  float far = smoothstep(0.15 * side.y, 0.6 * side.y, pixel);
  Marks marks;
  vec3 tint = vec3(1.0 + 0.5 * draw.x + 0.25 * (fine - 0.5)) * mix(vec3(1.0), vec3(1.10, 0.95, 0.86), draw.y + 0.5);
  tint *= mix(1.0, 1.16, broken);
  vec3 grey = vec3(1.15, 2.6, 3.2) * (0.86 + 0.28 * fine);
  marks.shade = mix(mix(tint, grey, mortar), vec3(1.0, 1.12, 1.16), far);
  // Mortar lies deeper, and edges are worn.
  vec3 worn = sign(off) * smoothstep(3.0 * width, width, edge) * (1.0 - far);
  marks.bump = off_face(-0.55 * vec3(worn.xy, 0.0), n) + broken * draw * 0.9 * (1.0 - mortar) * (1.0 - far);
  marks.open = 1.0 - 0.35 * mortar * (1.0 - far);
  return marks;
}

// Boards along x, whose ends have rings. On a face that looks along x they stand across it, unless it is broken.
Marks planks_at(vec3 p, vec3 n, float size, float broken, float pixel, vec4 middle) {
  bool end = abs(n.x) > max(abs(n.y), abs(n.z)) && broken > 0.3;
  bool flat_face = abs(n.y) > max(abs(n.x), abs(n.z));
  // x along a board, y across its width, z through it.
  vec3 q = end || flat_face ? p.xzy : on_face(p, n);
  vec2 board = floor(q.yz / vec2(size, 0.5 * size));
  if (!end && broken < 0.5) board.y = 0.0;
  vec3 draw = drawn(ivec3(int(board.x), int(board.y), 5));
  float run = q.x + 7.0 * draw.x;
  float length_m = 16.0 * size;
  float piece = floor(run / length_m);
  draw = drawn(ivec3(int(board.x), int(board.y), int(piece)));
  float across = q.y - (board.x + 0.5) * size;
  float along = (fract(run / length_m) - 0.5) * length_m;
  float gap = joint_at(0.5 * size - abs(across), 0.03 * size, pixel);
  if (!end) gap = max(gap, joint_at(0.5 * length_m - abs(along), 0.02 * size, pixel));
  // Rings around the tree's middle, which lies beside the board: long lines on its face, arcs on its end.
  vec2 from_heart = vec2(across + size * draw.y, q.z - (board.y + 0.5) * 0.5 * size + size * (0.9 + 0.5 * draw.z));
  float radius = length(from_heart) + 0.03 * size * (middle.x - 0.5) + 0.012 * size * sin(0.6 * run / size + 6.0 * draw.x);
  float rings = noise_1d(radius * 26.0 / size, 11 + int(16.0 * (draw.x + 0.5)));
  float fibre = noise(vec3(run * 3.0 / size, q.y * 55.0 / size, q.z * 55.0 / size)).x;
  float near = 1.0 - smoothstep(0.03 * size, 0.10 * size, pixel);
  float far = smoothstep(0.3 * size, 1.0 * size, pixel);
  Marks marks;
  float shade = 1.0 + 0.40 * draw.y + near * (0.50 * (rings - 0.5) + 0.30 * (fibre - 0.5));
  shade *= mix(1.0, 1.25, broken);
  marks.shade = mix(vec3(shade) * mix(vec3(1.0), vec3(0.24, 0.20, 0.18), gap), vec3(0.94), far);
  float worn = sign(across) * smoothstep(0.10 * size, 0.03 * size, 0.5 * size - abs(across)) * (1.0 - far);
  vec3 slope = vec3(0.0, -0.5 * worn + near * 0.25 * (fibre - 0.5), 0.0);
  marks.bump = end || flat_face ? slope.xzy : off_face(slope, n);
  marks.open = 1.0 - 0.4 * gap * (1.0 - far);
  return marks;
}

// Beds, each of its own shade, with ledges.
Marks strata_at(vec3 p, float size, float pixel, vec4 coarse, float fine) {
  float height = (p.y + 1.2 * size * (coarse.x - 0.5)) / size;
  float bed = noise_1d(height * 0.5, 23);
  float seam = noise_1d(height * 3.7, 29);
  float far = smoothstep(0.2 * size, size, pixel);
  Marks marks;
  marks.shade = vec3(mix(1.0, (0.72 + 0.56 * bed) * (0.88 + 0.24 * seam), 1.0 - far)) * (0.85 + 0.3 * fine);
  marks.bump = vec3(0.0, 0.5 * (seam - 0.5), 0.0) * (1.0 - far);
  marks.open = 1.0;
  return marks;
}

Marks pebbles_at(vec3 p, float size, float pixel) {
  Stone stone = stone_at(p / size);
  float far = smoothstep(0.2 * size, 0.7 * size, pixel);
  float deep = 1.0 - smoothstep(0.0, 0.20 + pixel / size, stone.edge);
  Marks marks;
  vec3 tint = vec3(1.0 + 1.1 * stone.way.x) * (1.0 + vec3(0.16, 0.0, -0.16) * stone.way.y * 2.0);
  marks.shade = mix(tint * (1.0 - 0.75 * deep), vec3(0.82), far);
  marks.bump = -1.5 * stone.off * (1.0 - far);
  marks.open = 1.0 - 0.5 * deep * (1.0 - far);
  return marks;
}

Marks grain_at(vec3 p, float size, float pixel) {
  vec4 large = noise(p / size);
  vec4 small = noise(p * 2.9 / size + 11.0);
  float near = 1.0 - smoothstep(0.3 * size, 1.2 * size, pixel);
  Marks marks;
  marks.shade = vec3(1.0 + near * (0.9 * (large.x - 0.5) + 0.6 * (small.x - 0.5)));
  marks.bump = (0.22 * large.yzw + 0.16 * small.yzw) * near;
  marks.open = 1.0;
  return marks;
}

// Pores, as concrete has them: where the colour varies at all, and the surface is dull.
Marks plain_at(vec3 p, float pores, float pixel, vec4 small) {
  Marks marks = Marks(vec3(1.0), small.yzw * 0.02, 1.0);
  const float size = 0.11;
  float near = pores * (1.0 - smoothstep(0.006, 0.02, pixel));
  if (near <= 0.0) return marks;
  ivec3 cell = ivec3(floor(p / size));
  vec3 draw = drawn(cell);
  float hole = length(fract(p / size) - 0.5 - 0.6 * draw);
  hole = 1.0 - smoothstep(0.08, 0.13, hole + 0.1 * lattice(cell + ivec3(0, 0, 7919)));
  marks.shade = vec3(1.0 - 0.55 * hole * near);
  marks.open = 1.0 - 0.3 * hole * near;
  return marks;
}

// So turned that no face of what people build lies along the lattice.
const mat3 grain_turn = mat3(0.66, 0.47, -0.58, -0.74, 0.53, -0.42, 0.11, 0.71, 0.70);

// What a centimetre shows of a surface, as near as a pixel can tell: fibres along a board, thin layers of a bed, and
// grains and pits of everything else. Polished surfaces have none.
void add_grains(inout Marks marks, vec3 p, int pattern, float rough, float variation, float pixel) {
  const float grain_m = 0.011;
  float near = rough * rough * (1.0 - smoothstep(0.20 * grain_m, 0.44 * grain_m, pixel));
  bool drawn_out = pattern == pattern_planks || pattern == pattern_strata;
  vec3 along = pattern == pattern_planks ? vec3(0.10, 1.0, 1.0) : vec3(0.6, 1.6, 0.6);
  vec3 q = (drawn_out ? p * along : grain_turn * p) / grain_m;
  vec4 grain = noise(q + 31.0);
  vec4 finer = noise(q * 2.3);
  float closer = near * (1.0 - smoothstep(0.08 * grain_m, 0.2 * grain_m, pixel));
  float even = grain.x + 0.5 * closer * (finer.x - 0.5);
  float pit = drawn_out ? 0.0 : smoothstep(0.74, 0.92, even);
  vec3 slope = grain.yzw * 0.15 + finer.yzw * (0.12 * closer);
  marks.shade *= 1.0 + near * ((0.20 + 0.5 * variation) * (even - 0.5) - 0.15 * pit);
  marks.bump += near * (drawn_out ? along * slope : slope * grain_turn);
  marks.open *= 1.0 - 0.2 * pit * near;
}

#if SURFACES > 1

uniform highp sampler2DArray u_images;

// An image as it lies on the three faces of space, each as much as the surface faces that way. Its top is up, and it is
// no mirror image from outside.
struct Faces {
  vec3 weights;
  vec2 x, y, z;  // places in the image
  float level;   // of its mipmaps
};

Faces faces_of(vec3 p, vec3 n, float size, float pixel) {
  vec3 side = vec3(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0, n.z < 0.0 ? -1.0 : 1.0);
  vec3 a = n * n;
  a *= a * a;
  vec3 q = p / size;
  Faces faces;
  faces.weights = a / (a.x + a.y + a.z);
  faces.x = vec2(-side.x * q.z, -q.y);
  faces.y = vec2(q.x, side.y * q.z);
  faces.z = vec2(side.z * q.x, -q.y);
  faces.level = log2(max(pixel / size * float(textureSize(u_images, 0).x), 1.0));
  return faces;
}

vec3 image_at(Faces faces, float layer) {
  return textureLod(u_images, vec3(faces.x, layer), faces.level).rgb * faces.weights.x +
         textureLod(u_images, vec3(faces.y, layer), faces.level).rgb * faces.weights.y +
         textureLod(u_images, vec3(faces.z, layer), faces.level).rgb * faces.weights.z;
}

// What an image of normals (x along the image, y up, z out of it) adds to the slopes that bend a normal.
vec3 slopes_at(Faces faces, float layer, vec3 n) {
  vec3 side = vec3(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0, n.z < 0.0 ? -1.0 : 1.0);
  vec3 on_x = textureLod(u_images, vec3(faces.x, layer), faces.level).rgb * 2.0 - 1.0;
  vec3 on_y = textureLod(u_images, vec3(faces.y, layer), faces.level).rgb * 2.0 - 1.0;
  vec3 on_z = textureLod(u_images, vec3(faces.z, layer), faces.level).rgb * 2.0 - 1.0;
  vec3 bent = vec3(0.0, on_x.y, -side.x * on_x.x) / max(on_x.z, 0.2) * faces.weights.x;
  bent += vec3(on_y.x, 0.0, -side.y * on_y.y) / max(on_y.z, 0.2) * faces.weights.y;
  bent += vec3(side.z * on_z.x, on_z.y, 0.0) / max(on_z.z, 0.2) * faces.weights.z;
  return -bent;
}

#endif

// `look`: 1 + a row. `coarse`, `middle`, `small`: noise at p, by metres, 80 cm and 20 cm. `away`: metres from the eye.
Rock material_at(int look, vec3 p, vec3 n, vec4 coarse, vec4 middle, vec4 small, float away) {
  vec4 colour = texelFetch(u_materials, ivec2(look - 1, 0), 0);
  vec4 kind = texelFetch(u_materials, ivec2(look - 1, 1), 0);
  float variation = colour.a, roughness = kind.x, size = max(kind.z, 0.005);
  int pattern = int(kind.y + 0.5);
  float pixel = 0.0016 * away;  // metres that it covers, about
  float fine = 0.6 * middle.x + 0.4 * small.x;
  // What people make has faces along the axes: others are broken, and so are its edges. Loose ground breaks no such face.
  vec3 a = abs(n);
  float broken = smoothstep(0.12, 0.26, 1.0 - max(a.x, max(a.y, a.z))) * (1.0 - smoothstep(0.96, 1.0, roughness));
  broken *= smoothstep(0.1, 0.3, roughness);
  if (is_whole) broken = 0.0;
  Marks marks;
  if (pattern == pattern_bricks) marks = bricks_at(p, n, size, broken, pixel, small.x);
  else if (pattern == pattern_planks) marks = planks_at(p, n, size, broken, pixel, middle);
  else if (pattern == pattern_strata) marks = strata_at(p, size, pixel, coarse, fine);
  else if (pattern == pattern_pebbles) marks = pebbles_at(p, size, pixel);
  else if (pattern == pattern_grain) marks = grain_at(p, size, pixel);
  else marks = plain_at(p, smoothstep(0.03, 0.06, variation) * smoothstep(0.5, 0.8, roughness), pixel, small);
  // Brightness from place to place; patterns have a part in it.
  float uneven = 1.0 + variation * (1.2 * (coarse.x - 0.5) + 1.6 * (fine - 0.5));
  if (pattern != pattern_strata) marks.shade = mix(vec3(1.0), marks.shade, min(1.0, 0.35 + 3.0 * variation));
  add_grains(marks, p, pattern, roughness, variation, pixel);
#if SURFACES > 1
  // An image is drawn in place of colour and pattern, one of normals in place of the pattern's relief.
  vec4 image = texelFetch(u_materials, ivec2(look - 1, 2), 0);
  if (max(image.x, image.y) >= 0.0) {
    Faces faces = faces_of(p, n, image.z, pixel);
    if (image.x >= 0.0) {
      colour.rgb = pow(image_at(faces, image.x), vec3(2.2));
      marks.shade = vec3(1.0);
      marks.open = 1.0;
    }
    marks.bump = image.y >= 0.0 ? slopes_at(faces, image.y, n) : vec3(0.0);
  }
#endif
  Rock rock;
  rock.albedo = clamp(colour.rgb * uneven * marks.shade, 0.0, 1.0);
  // Broken faces are uneven, in chips.
  vec3 chips = (small.yzw * 0.35 + middle.yzw * 0.45) * broken;
  vec3 bump = marks.bump + chips + (middle.yzw * 0.02 + small.yzw * 0.04) * roughness * roughness;
  rock.normal = normalize(n - (bump - n * dot(bump, n)) / (1.0 + away * 0.03));
  rock.open = marks.open;
  rock.roughness = mix(roughness, 1.0, 0.7 * broken);
  return rock;
}

#endif
