// Meshes of surface nets: blocks of terrain and pieces (shared/surface/surface_nets.h, SurfaceVertex).

layout(location = 0) in vec3 a_position;  // 1/256 voxel, from the mesh's origin
layout(location = 1) in vec3 a_normal;
layout(location = 2) in float a_openness;
layout(location = 3) in float a_worn;  // packed_worn() of client/render/levels/surface_looks.h
layout(location = 4) in float a_look;  // 0: as the ground; else 1 + a row of the palette
layout(location = 5) in float a_piece;  // which one, if it is a piece's

uniform mat4 u_view_projection;
uniform float u_step;         // voxels a step of a_position
uniform vec3 u_origin;        // of terrain, voxels
uniform float u_voxel_m;
uniform vec3 u_eye;
uniform float u_loose;        // 1 for pieces, 0 for terrain
uniform float u_lift;         // metres: pieces are drawn in front of terrain that is so little nearer

out vec3 v_world;
out vec3 v_rock;  // in the frame of the rock: patterns stay with a piece that moves
out vec3 v_rock_normal;
out float v_openness;
out vec2 v_worn;     // rock.glsl
flat out int v_look;  // of all three vertices
flat out vec4 v_rotation;  // quaternion x, y, z, w
flat out float v_tint;     // 0..1, of a piece
flat out float v_piece;    // which one

const float worn_step = 58.0 / 127.0 / 15.0;

void main() {
  vec3 origin = u_origin, centre_m = vec3(0.0);
  vec4 place = vec4(0.0);
  v_rotation = vec4(0.0, 0.0, 0.0, 1.0);
#ifdef PIECES
  if (u_loose > 0.0) {
    int piece = int(a_piece);
    place = of_piece(piece, 0);
    v_rotation = of_piece(piece, 1);
    origin = of_piece(piece, 2).xyz;
    centre_m = of_piece(piece, 3).xyz;
  }
#endif
  // Voxels are exact; metres are rounded once. So blocks meet to the bit, whatever the size of a voxel.
  v_rock = (origin + a_position * u_step) * u_voxel_m;
  v_world = place.xyz + rotated(v_rotation, v_rock - centre_m);
  v_tint = place.w;
  v_piece = a_piece;
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
