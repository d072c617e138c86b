// The raymarcher's copy of the field (client/render/bricks/brick_world.h): levels of bricks around the camera,
// each in a window of its own; level k has a voxel every 2^k. Points are metres from the eye, distances voxels.

const int levels_max = 8;
const uint kind_unloaded = 0u;  // between: empty, and so many bricks to the nearest that is not
const uint kind_stored = 254u;
const uint kind_solid = 255u;
const float band = 3.0;       // distances saturate there
const float brick = 8.0;      // voxels a side
const float brick_pitch = 11.0;  // with the apron, one voxel of which lies before the brick
const int corner_pitch = 9;      // voxels a side of a brick in the atlases of looks and planes
// Voxels before a window's border where the next level takes over: a ray that nears the border sees beyond it.
const float border = 16.0;

uniform usampler3D u_entries;
uniform usampler3D u_looks;
uniform sampler3D u_planes;
uniform sampler3D u_atlas;
uniform vec3 u_atlas_texel;
uniform ivec3 u_window;  // bricks; along x and z a power of two, along y half of it
uniform int u_levels;
uniform vec3 u_eye_in[levels_max];  // voxels, from the window's lowest corner
uniform ivec3 u_wrap[levels_max];   // where that corner's brick lies in the entries
uniform float u_voxels_per_m[levels_max];

const float cut_begins = -0.08;  // of the field as generated, code / 127 (rock.glsl)
const float turned_begins = 0.35;  // of the same above the surface, where that faces another way
const float worn_all = 0.46;     // nothing of the weathered ground is left
const float probe_height = 2.75;  // voxels, as for meshes (shared/surface/surface_nets.h)

uvec4 entry_at(ivec3 at, int level) {
  ivec3 i = (at + u_wrap[level]) & (u_window - 1);
  return texelFetch(u_entries, ivec3(i.z, i.y + level * u_window.y, i.x), 0);
}

// Trilinear value in a stored brick, `local` voxels from its first. Rounded to 1/256 voxel, which is what hardware
// filters by: so the texture coordinate is exact, and the value the same in any slot.
float brick_value(uint entry, vec3 local) {
  vec3 slot = vec3(float(entry & 255u), float((entry >> 8u) & 255u), float((entry >> 16u) & 255u));
  vec3 at = floor(local.zyx * 256.0 + 0.5) * (1.0 / 256.0);
  return textureLod(u_atlas, (slot * brick_pitch + at + 1.5) * u_atlas_texel, 0.0).r * band;
}

vec3 brick_gradient(uint entry, vec3 local) {
  vec2 h = vec2(1.0, 0.0);
  return vec3(brick_value(entry, local + h.xyy) - brick_value(entry, local - h.xyy),
              brick_value(entry, local + h.yxy) - brick_value(entry, local - h.yxy),
              brick_value(entry, local + h.yyx) - brick_value(entry, local - h.yyx));
}

#ifdef EDGES

// What the planes at the corners of a cell say (shared/surface/face_plane.h): the largest and the smallest distance
// from them, and their normals. No edge: there all are of one face, or say nothing together.
struct CellFaces {
  bool edge;
  float most;
  float least;
  vec3 most_normal;
  vec3 least_normal;
  vec4 blended;  // mean normal by how near the corners are, w: the share of those that know a plane
};

// The normal's squared length tells whether a corner knows a plane, and whether the cell above it is an edge
// (client/render/levels/plane_brick.h).
const float edge_scale = 127.0 / 95.0;
bool is_known(float square) { return square > 0.3; }
bool is_edge(float square) { return square > 0.03 && square < 0.8; }

ivec3 planes_slot(uint planes, vec3 local) {
  ivec3 slot = ivec3(int(planes & 255u), int((planes >> 8u) & 255u), int((planes >> 16u) & 255u)) * corner_pitch;
  return slot + clamp(ivec3(floor(local)), ivec3(0), ivec3(7)).zyx;
}

CellFaces faces_at(uint planes, vec3 local) {
  ivec3 slot = planes_slot(planes, local);
  vec3 f = local - clamp(floor(local), vec3(0.0), vec3(7.0));
  CellFaces faces = CellFaces(false, -100.0, 100.0, vec3(0.0), vec3(0.0), vec4(0.0));
  // As in sharp_value(): so most pixels have no loop.
  int corners = planes == 0u ? 0 : 8;
  for (int i = 0; i < corners; ++i) {
    ivec3 corner = ivec3(i >> 2, (i >> 1) & 1, i & 1);
    vec4 plane = texelFetch(u_planes, slot + corner.zyx, 0);
    float square = dot(plane.xyz, plane.xyz);
    if (i == 0) faces.edge = is_edge(square);
    if (!is_known(square)) continue;
    plane.xyz *= is_edge(square) ? edge_scale : 1.0;
    float away = plane.w * band + dot(plane.xyz, f - vec3(corner));
    if (away > faces.most) {
      faces.most = away;
      faces.most_normal = plane.xyz;
    }
    if (away < faces.least) {
      faces.least = away;
      faces.least_normal = plane.xyz;
    }
    vec3 near = mix(1.0 - f, f, vec3(corner));
    faces.blended += vec4(plane.xyz, 1.0) * (near.x * near.y * near.z);
  }
  return faces;
}

// Farther from the surface than this no edge lies, but that of a wedge below 45 degrees.
const float sharp_reach = 1.3;

// Whether planes may say another distance there than the trilinear one. An entry says in which eighths of the brick edges
// lie.
bool nears_edge(uvec4 entry, vec3 local, float smooth_value) {
  ivec3 far = ivec3(greaterThanEqual(local, vec3(4.0)));
  return (entry.w >> uint(24 + far.x * 4 + far.y * 2 + far.z) & 1u) != 0u && smooth_value < sharp_reach;
}

// Where faces meet, the trilinear value is rounded: planes go on up to the edge, the largest where rock is convex, the
// smallest where it is hollow.
float sharp_value(uvec4 entry, vec3 local, float smooth_value) {
  ivec3 slot = planes_slot(entry.w, local);
  vec3 f = local - clamp(floor(local), vec3(0.0), vec3(7.0));
  float most = -100.0, least = 100.0;
  // A number that compilers do not know: they would unroll the loop, which a processor that draws then cannot leave.
  int corners = 1;
  for (int i = 0; i < corners; ++i) {
    ivec3 corner = ivec3(i >> 2, (i >> 1) & 1, i & 1);
    vec4 plane = texelFetch(u_planes, slot + corner.zyx, 0);
    float square = dot(plane.xyz, plane.xyz);
    if (i == 0 && is_edge(square)) corners = 8;
    float away = plane.w * band + (is_edge(square) ? edge_scale : 1.0) * dot(plane.xyz, f - vec3(corner));
    most = max(most, is_known(square) ? away : -100.0);
    least = min(least, is_known(square) ? away : 100.0);
  }
  return corners > 1 ? clamp(smooth_value, least, most) : smooth_value;
}

#endif

// The surface's own normal in a stored brick, not that of the rounded field beside an edge.
vec3 brick_normal(uvec4 entry, vec3 local, vec3 otherwise) {
  vec3 slope = brick_gradient(entry.x, local);
  vec3 normal = dot(slope, slope) > 0.0 ? normalize(slope) : otherwise;
#ifdef EDGES
  if (entry.w == 0u) return normal;
  CellFaces faces = faces_at(entry.w, local);
  float smooth_value = brick_value(entry.x, local);
  if (faces.edge) {
    if (faces.most < smooth_value + 0.06) return normalize(faces.most_normal);
    return faces.least > smooth_value - 0.06 ? normalize(faces.least_normal) : normal;
  }
  normal = normalize(mix(normal, faces.blended.xyz / max(faces.blended.w, 0.01), faces.blended.w));
#endif
  return normal;
}

// The field as generated, code / 127: what an entry says of it, `same` where nothing was edited.
float generated_in(uvec4 entry, vec3 local, float same) {
  uint kind = entry.y >> 24u;
  if (kind == 1u) return brick_value(entry.y, local) / band;
  return kind == 2u ? 1.0 : kind == 3u ? -1.0 : same;
}

vec3 in_level(vec3 from_eye, int level) { return u_eye_in[level] + from_eye * u_voxels_per_m[level]; }

// Distance at a point, as far as the band; what is not there counts as air.
float field_at(vec3 from_eye, int level) {
  vec3 p = in_level(from_eye, level);
  ivec3 at = ivec3(floor(p / brick));
  if (any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, u_window))) return band;
  uint entry = entry_at(at, level).x;
  uint kind = entry >> 24u;
  if (kind == kind_stored) return brick_value(entry, p - vec3(at) * brick);
  return kind == kind_solid ? -band : band;
}

// The field as generated at a point; what is not there counts as air.
float generated_at(vec3 from_eye, int level) {
  vec3 p = in_level(from_eye, level);
  ivec3 at = ivec3(floor(p / brick));
  if (any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, u_window))) return 1.0;
  return generated_in(entry_at(at, level), p - vec3(at) * brick, field_at(from_eye, level) / band);
}

// What the surface looks like at a point in a brick (client/render/levels/look_window.h): as the nearest voxel to a point
// half a voxel beneath it. 0: as the ground.
int look_at(uvec4 entry, vec3 local, vec3 normal, float before) {
  uvec2 looks = uvec2(entry.z & 255u, (entry.z >> 8u) & 255u);
  if (entry.z >> 24u != 0u) {
    ivec3 slot = ivec3(int(entry.z & 255u), int((entry.z >> 8u) & 255u), int((entry.z >> 16u) & 255u));
    ivec3 at = clamp(ivec3(floor(local - 0.5 * normal + 0.5)), ivec3(0), ivec3(corner_pitch - 1));
    looks = texelFetch(u_looks, slot * corner_pitch + at.zyx, 0).rg;
  }
  return int(before < cut_begins ? looks.y : looks.x);
}

// How far the field as generated was from a point of the surface, for its looks (rock.glsl): x where rock has gone from
// there, y where rock has come. Where the ground was at the same place but faced another way, what is above tells
// whether rock has gone. Something else above may be as near as `other`, voxels.
vec2 worn_at(vec3 from_eye, vec3 normal, int level, float before, float other) {
  float worn = before;
  if (abs(before) < worn_all) {
    vec3 above = from_eye + normal * (probe_height / u_voxels_per_m[level]);
    float now = min(field_at(above, level), other) / band;
    float gone = now - generated_at(above, level) - turned_begins;
    if (gone > abs(before)) worn = -gone;
  }
  return vec2(max(-worn, 0.0), max(worn, 0.0));
}

// The finest level, from `level` on, that shows this point; u_levels beyond all.
int level_of(vec3 from_eye, int level) {
  for (; level < u_levels; ++level) {
    vec3 p = in_level(from_eye, level);
    float margin = level + 1 < u_levels ? border : 0.0;
    vec3 inside = min(p, vec3(u_window) * brick - p);
    if (min(inside.x, min(inside.y, inside.z)) > margin) return level;
  }
  return level;
}

// One look at the field from a point on a ray.
struct Look {
  uint kind;
  uvec4 entry;
  vec3 local;      // in its brick, voxels
  vec3 lo;         // of the empty box around, from the point, voxels
  vec3 hi;
  float distance;  // of a stored brick: to the surface, voxels, its edges rounded
};

Look look(vec3 from_eye, int level) {
  vec3 p = in_level(from_eye, level);
  vec3 at = floor(p / brick);
  Look found;
  found.entry = entry_at(ivec3(at), level);
  found.kind = found.entry.x >> 24u;
  found.local = p - at * brick;
  found.distance = band;
  float bricks = 0.0;
  if (found.kind == kind_stored) {
    found.distance = brick_value(found.entry.x, found.local);
  } else {
    bricks = float(found.kind) - 1.0;
  }
  found.lo = max((at - bricks) * brick, vec3(0.0)) - p;
  found.hi = min((at + bricks + 1.0) * brick, vec3(u_window) * brick) - p;
  return found;
}

// How far along a direction the empty box around reaches, voxels.
float way_out(Look found, vec3 inverse_direction) {
  vec3 far = max(found.lo * inverse_direction, found.hi * inverse_direction);
  return min(far.x, min(far.y, far.z)) + 0.004;
}
