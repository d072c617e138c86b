// Boxes around pieces, one instance each (client/render/pieces/piece_volumes.h). No buffer holds the corners.

layout(location = 0) in vec4 a_place;     // metres; w: tint
layout(location = 1) in vec4 a_rotation;  // quaternion x, y, z, w
layout(location = 2) in vec3 a_centre;    // voxels, from the box's lowest corner: what lies at the place
layout(location = 3) in vec3 a_size;      // voxels
layout(location = 4) in vec3 a_origin;    // lowest corner, voxels in the frame of the rock
layout(location = 5) in ivec4 a_bricks;   // first entry; bricks along x, y and z

uniform mat4 u_view_projection;
uniform vec3 u_eye;

out vec3 v_world;
out vec3 v_local;  // voxels, from the box's lowest corner
flat out vec4 v_rotation;
flat out vec3 v_size;
flat out vec3 v_origin;
flat out ivec4 v_bricks;
flat out float v_tint;
flat out float v_dust;  // 1 on the ground, 0 in the air

void main() {
  const int corners[36] = int[36](0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6,
                                  2, 1, 3, 7, 1, 7, 5);
  int corner = corners[gl_VertexID];
  float voxel_m = 1.0 / u_voxels_per_m[0];
  v_local = vec3(float(corner & 1), float((corner >> 1) & 1), float(corner >> 2)) * a_size;
  v_world = a_place.xyz + rotated(a_rotation, (v_local - a_centre) * voxel_m);
  v_rotation = a_rotation;
  v_size = a_size;
  v_origin = a_origin;
  v_bricks = a_bricks;
  v_tint = a_place.w;
  // Two levels up the field knows of ground that is four times as far away.
  int level = min(2, u_levels - 1);
  float radius_m = 0.5 * max(a_size.x, max(a_size.y, a_size.z)) * voxel_m;
  float above_m = field_at(a_place.xyz - u_eye, level) / u_voxels_per_m[level];
  v_dust = 1.0 - smoothstep(radius_m + 0.4, radius_m + 1.2, above_m);
  gl_Position = u_view_projection * vec4(v_world, 1.0);
}
