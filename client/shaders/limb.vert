// Limbs of persons, an instance each (client/render/scene/limb.h).

layout(location = 0) in vec4 a_point;     // on the ball; w: its half
layout(location = 1) in vec4 a_middle;    // metres; w: by which a half is moved
layout(location = 2) in vec4 a_rotation;  // quaternion x, y, z, w
layout(location = 3) in vec3 a_radius;
layout(location = 4) in vec4 a_colour;    // square roots of linear light

uniform mat4 u_view_projection;

out vec3 v_world;
out vec3 v_normal;
flat out vec3 v_colour;

void main() {
  vec3 p = a_point.xyz * a_radius + vec3(0.0, a_point.w * a_middle.w, 0.0);
  v_world = a_middle.xyz + rotated(a_rotation, p);
  v_normal = rotated(a_rotation, a_point.xyz / a_radius);
  v_colour = a_colour.rgb * a_colour.rgb;
  gl_Position = u_view_projection * vec4(v_world, 1.0);
}
