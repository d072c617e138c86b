// Meshes of surface nets: blocks of terrain and pieces (shared/surface/surface_nets.h, SurfaceVertex).

layout(location = 0) in vec3 a_position;  // 1/256 voxel, from the mesh's origin
layout(location = 1) in vec3 a_normal;
layout(location = 2) in float a_openness;
layout(location = 3) in float a_worn;  // packed_worn() of client/render/levels/surface_looks.h
layout(location = 4) in float a_look;  // 0: as the ground; else 1 + a row of the palette

uniform mat4 u_view_projection;
uniform float u_step;         // voxels a step of a_position
uniform vec3 u_origin;        // voxels: of the mesh, in the frame of the rock that it is or was
uniform float u_voxel_m;
uniform vec3 u_centre_m;      // in that frame: what lies at u_place_m
uniform vec3 u_place_m;
uniform vec4 u_rotation;      // quaternion x, y, z, w
uniform vec3 u_eye;
uniform float u_loose;        // 1 for a piece, 0 for terrain
uniform float u_lift;         // metres: pieces are drawn in front of terrain that is so little nearer

out vec3 v_world;
out vec3 v_rock;  // in the frame of the rock: patterns stay with a piece that moves
out vec3 v_rock_normal;
out float v_openness;
out vec2 v_worn;     // rock.glsl
flat out int v_look;  // of all three vertices

const float worn_step = 58.0 / 127.0 / 15.0;

void main() {
  // Voxels are exact; metres are rounded once. So blocks meet to the bit, whatever the size of a voxel.
  v_rock = (u_origin + a_position * u_step) * u_voxel_m;
  v_world = u_place_m + rotated(u_rotation, v_rock - u_centre_m);
  v_rock_normal = a_normal;
  v_openness = a_openness;
  float come = floor(a_worn / 16.0);
  v_worn = vec2(a_worn - 16.0 * come, come) * worn_step;
  v_look = int(a_look);
  gl_Position = u_view_projection * vec4(v_world, 1.0);
  // A stone that merged lies in the surface of the terrain that it became. Behind the eye there is nothing to divide by.
  if (u_loose > 0.0 && gl_Position.w > 2.0 * u_lift) {
    vec3 to_eye = u_eye - v_world;
    vec4 nearer = u_view_projection * vec4(v_world + to_eye * (u_lift / length(to_eye)), 1.0);
    gl_Position.z = nearer.z / nearer.w * gl_Position.w;
  }
}
