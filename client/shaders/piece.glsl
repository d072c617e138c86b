// Sphere tracing through one piece's volume. Needs bricks.glsl and rotation.glsl.

in vec3 v_world;
in vec3 v_local;
flat in vec4 v_rotation;
flat in vec3 v_size;
flat in vec3 v_origin;
flat in ivec4 v_bricks;
flat in float v_tint;
flat in float v_dust;

const int piece_entries_row = 256;  // entries in a row of the texture

uniform usampler2D u_piece_entries;
uniform vec4 u_viewpoint;  // w 1: the eye; 0: the direction towards it
uniform mat4 u_view_projection;

vec4 unturned() { return vec4(-v_rotation.xyz, v_rotation.w); }

uvec4 piece_entry_at(ivec3 at) {
  at = clamp(at, ivec3(0), v_bricks.yzw - 1);
  int i = v_bricks.x + (at.x * v_bricks.z + at.y) * v_bricks.w + at.z;
  return texelFetch(u_piece_entries, ivec2(i % piece_entries_row, i / piece_entries_row), 0);
}

// Distance in voxels; outside is air.
float piece_at(vec3 local) {
  if (any(lessThan(local, vec3(0.0))) || any(greaterThan(local, v_size))) return band;
  vec3 at = floor(local / brick);
  uint entry = piece_entry_at(ivec3(at)).x;
  uint kind = entry >> 24u;
  if (kind == kind_stored) return brick_value(entry, local - at * brick);
  return kind == kind_solid ? -band : band;
}

struct PieceHit {
  bool found;
  vec3 local;   // voxels
  vec3 world;
  uvec4 entry;  // 0 in the middle of a piece
  vec3 in_brick;
};

// Looks at the piece; returns the trilinear distance, voxels, in empty bricks as far as the brick is.
float look_at_piece(vec3 local, vec3 inverse_direction, inout PieceHit hit) {
  hit.local = clamp(local, vec3(0.0), v_size);
  vec3 at = min(floor(hit.local / brick), vec3(v_bricks.yzw - 1));
  hit.entry = piece_entry_at(ivec3(at));
  hit.in_brick = hit.local - at * brick;
  uint kind = hit.entry.x >> 24u;
  if (kind == kind_stored) return brick_value(hit.entry.x, hit.in_brick);
  if (kind == kind_solid) {
    hit.entry = uvec4(0u);
    return -band;
  }
  vec3 far = max(-hit.in_brick * inverse_direction, (brick - hit.in_brick) * inverse_direction);
  return (min(far.x, min(far.y, far.z)) + 0.004) / 0.9;
}

// From where the ray enters the box to its far side, where the fragment lies.
PieceHit march_piece() {
  vec3 direction = u_viewpoint.w > 0.5 ? normalize(v_world - u_viewpoint.xyz) : -u_viewpoint.xyz;
  vec3 ahead = rotated(unturned(), direction);
  vec3 inverse_direction = 1.0 / mix(ahead, vec3(1e-7), lessThan(abs(ahead), vec3(1e-7)));
  vec3 enter = min(-v_local * inverse_direction, (v_size - v_local) * inverse_direction);
  float along = max(enter.x, max(enter.y, enter.z));
  if (u_viewpoint.w > 0.5) along = max(along, -length(v_world - u_viewpoint.xyz) * u_voxels_per_m[0]);
  PieceHit hit;
  hit.found = false;
  int steps = 0;
  bool goes_on = along < 0.0;
  // Planes are asked in a loop of their own (march.glsl).
  while (goes_on) {
    bool edge = false;
    for (; steps < 96 && along < 0.0; ++steps) {
      float distance = look_at_piece(v_local + ahead * along, inverse_direction, hit);
#ifdef EDGES
      edge = nears_edge(hit.entry, distance);
#endif
      hit.found = !edge && distance < 0.02;
      if (edge || hit.found) break;
      along += max(distance * 0.9, 0.02);
    }
#ifdef EDGES
    for (; edge && steps < 96 && along < 0.0; ++steps) {
      float distance = sharp_value(hit.entry, hit.in_brick, brick_value(hit.entry.x, hit.in_brick));
      hit.found = distance < 0.02;
      if (hit.found) break;
      along += max(distance * 0.9, 0.02);
      distance = look_at_piece(v_local + ahead * along, inverse_direction, hit);
      edge = nears_edge(hit.entry, distance);
    }
#endif
    goes_on = !hit.found && steps < 96 && along < 0.0;
  }
  hit.world = v_world + direction * (along / u_voxels_per_m[0]);
  return hit;
}

float depth_of(vec3 world) {
  vec4 clip = u_view_projection * vec4(world, 1.0);
  return clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0);
}
