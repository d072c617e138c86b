// Models of props, an instance each (client/render/pieces/prop_views.h).

layout(location = 0) in vec3 a_position;  // metres, in the prop's axes
layout(location = 1) in vec3 a_normal;    // about nothing: the face's own
layout(location = 2) in vec4 a_place;     // of the prop's origin, metres
layout(location = 3) in vec4 a_rotation;  // quaternion x, y, z, w
layout(location = 4) in vec3 a_colour;    // square roots of linear light

uniform mat4 u_view_projection;

out vec3 v_world;
out vec3 v_normal;
out vec3 v_colour;

void main() {
  v_world = a_place.xyz + rotated(a_rotation, a_position);
  v_normal = rotated(a_rotation, a_normal);
  v_colour = a_colour * a_colour;
  gl_Position = u_view_projection * vec4(v_world, 1.0);
}
