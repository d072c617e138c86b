// Parts of props, an instance each (client/render/pieces/prop_views.h).

layout(location = 0) in vec3 a_position;  // metres, in the part's axes
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec4 a_place;     // of the part's origin, metres; w: tint
layout(location = 3) in vec4 a_rotation;  // quaternion x, y, z, w
layout(location = 4) in vec4 a_pattern;   // where the part lies in its material, metres; w: 0, or 1 + a row of the palette

uniform mat4 u_view_projection;

out vec3 v_world;
out vec3 v_rock;  // in the frame of the material: patterns stay with what moves
out vec3 v_normal;
out vec3 v_rock_normal;
flat out vec4 v_rotation;
flat out float v_tint;
flat out int v_look;

void main() {
  v_rock = a_pattern.xyz + a_position;
  v_world = a_place.xyz + rotated(a_rotation, a_position);
  v_rock_normal = a_normal;
  v_normal = rotated(a_rotation, a_normal);
  v_rotation = a_rotation;
  v_tint = a_place.w;
  v_look = int(a_pattern.w + 0.5);
  gl_Position = u_view_projection * vec4(v_world, 1.0);
}
