// Marching cubes of one cell (shared/surface/cube_cases.h), for surface.frag. Needs bricks.glsl and march.glsl.
//
// A corner's distance depends on the corner alone, not on the cell: so cells meet. What is read from the atlas is
// read in the brick that the cell lies in, whose apron has all of its corners.

layout(points) in;
layout(triangle_strip, max_vertices = 15) out;

flat in ivec3 v_cell[];

uniform sampler2D u_lines;   // texel (i, axis): the i-th point along it, metres from the eye, and its level
uniform usampler2D u_cases;  // row: signs; a triangle's corner in each texel: corner | axis << 3 of its edge
uniform mat4 u_view_projection;
uniform vec3 u_eye;

out vec3 v_world;
out vec3 v_rock;
out vec3 v_rock_normal;
out float v_openness;
out vec2 v_worn;
flat out int v_look;
flat out vec4 v_rotation;
flat out float v_tint;

const float nowhere = 1e9;
const uint no_corner = 255u;

// The brick of the cell on one level.
struct Home {
  int level;
  uvec4 entry;
  vec3 first;  // voxels
};

Home home_on(int level, vec3 middle) {
  vec3 at = floor(in_level(middle, level) / brick);
  Home home = Home(level, uvec4(0u), at * brick);
  if (all(greaterThanEqual(at, vec3(0.0))) && all(lessThan(at, vec3(u_window)))) home.entry = entry_at(ivec3(at), level);
  return home;
}

// Where a corner of that level is read; `last`: the home of the corner before, which is the same as a rule.
Home home_of(vec3 corner, int level, vec3 middle, Home last) {
  for (level = level_of(corner, level); level < u_levels; level = level_of(corner, level + 1)) {
    Home home = last;
    if (level != last.level) home = home_on(level, middle);
    if (home.entry.x >> 24u != kind_unloaded) return home;
  }
  return Home(u_levels, uvec4(0u), vec3(0.0));
}

// Metres; nowhere beyond all that is loaded.
float distance_at(vec3 corner, Home home) {
  if (home.level >= u_levels) return nowhere;
  uint kind = home.entry.x >> 24u;
  float voxels = kind == kind_solid ? -band : band;
  if (kind == kind_stored) voxels = brick_value(home.entry.x, in_level(corner, home.level) - home.first);
  return voxels / u_voxels_per_m[home.level];
}

void emit(vec3 from_eye, vec3 normal, Home home) {
  v_worn = vec2(0.0);
  v_look = 0;
  v_rotation = vec4(0.0, 0.0, 0.0, 1.0);
  v_tint = 0.0;
  if (home.entry.x >> 24u == kind_stored) {
    vec3 local = in_level(from_eye, home.level) - home.first;
    vec3 slope = brick_gradient(home.entry.x, local);
    if (dot(slope, slope) > 0.0) normal = normalize(slope);
    float before = generated_in(home.entry, local, 0.0);
    if (before != 0.0) v_worn = worn_at(from_eye, normal, home.level, before, band);
    v_look = look_at(home.entry, local, normal, before);
  }
  v_world = u_eye + from_eye;
  v_rock = v_world;
  v_rock_normal = normal;
  v_openness = cleft_openness_at(from_eye, normal, home.level, band);
  gl_Position = u_view_projection * vec4(v_world, 1.0);
  EmitVertex();
}

// Which of a cell's ends a corner lies at.
vec3 side_of(int corner) { return vec3(float(corner >> 2), float((corner >> 1) & 1), float(corner & 1)); }

void main() {
  vec2 lines[6];
  for (int axis = 0; axis < 3; ++axis) {
    lines[axis] = texelFetch(u_lines, ivec2(v_cell[0][axis], axis), 0).xy;
    lines[3 + axis] = texelFetch(u_lines, ivec2(v_cell[0][axis] + 1, axis), 0).xy;
  }
  vec3 lo = vec3(lines[0].x, lines[1].x, lines[2].x);
  vec3 hi = vec3(lines[3].x, lines[4].x, lines[5].x);
  float distances[8];
  Home homes[8];
  Home last = Home(-1, uvec4(0u), vec3(0.0));
  int signs = 0;
  for (int i = 0; i < 8; ++i) {
    float level = max(lines[3 * (i >> 2)].y, max(lines[1 + 3 * ((i >> 1) & 1)].y, lines[2 + 3 * (i & 1)].y));
    vec3 corner = mix(lo, hi, side_of(i));
    last = home_of(corner, int(level), 0.5 * (lo + hi), last);
    homes[i] = last;
    distances[i] = distance_at(corner, last);
    if (distances[i] >= nowhere) return;
    if (distances[i] < 0.0) signs |= 1 << i;
  }
  if (signs == 0 || signs == 255) return;
  for (int t = 0; t < 15; ++t) {
    uint edge = texelFetch(u_cases, ivec2(t, signs), 0).r;
    if (edge == no_corner) return;
    int from = int(edge & 7u);
    int to = from | (4 >> int(edge >> 3u));
    float along = distances[from] / (distances[from] - distances[to]);
    vec3 a = mix(lo, hi, side_of(from));
    vec3 b = mix(lo, hi, side_of(to));
    // Out of the rock, where there is no brick to ask.
    vec3 outwards = normalize(b - a) * (distances[from] < 0.0 ? 1.0 : -1.0);
    Home home = homes[from];
    if (homes[to].level > home.level) home = homes[to];
    emit(mix(a, b, along), outwards, home);
    if (t % 3 == 2) EndPrimitive();
  }
}
