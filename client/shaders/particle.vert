// Particles (client/render/scene/particle.h): squares that face the eye.

layout(location = 0) in vec3 a_place;
layout(location = 1) in float a_radius;
layout(location = 2) in vec4 a_colour;
layout(location = 3) in float a_turn;
layout(location = 4) in float a_slender;

uniform mat4 u_view_projection;
uniform vec3 u_eye;
uniform vec3 u_sun;
uniform vec3 u_right;  // across the picture and upwards in it, unit
uniform vec3 u_up;

out vec2 v_corner;       // -1..1
flat out vec3 v_albedo;
flat out float v_sunlight;
flat out float v_opacity;
flat out float v_turn;
flat out float v_slender;
out vec3 v_world;

void main() {
  v_corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  vec2 shape = v_corner * vec2(1.0, a_slender > 0.0 ? a_slender : 1.0);
  float c = cos(a_turn), s = sin(a_turn);
  vec2 turned = vec2(c * shape.x - s * shape.y, s * shape.x + c * shape.y) * a_radius;
  v_world = a_place + u_right * turned.x + u_up * turned.y;
  gl_Position = u_view_projection * vec4(v_world, 1.0);
  // A puff lies before what its foremost part would hide: so the ground does not cut it in a line.
  vec3 to_eye = u_eye - a_place;
  float away = max(length(to_eye), 1e-3);
  if (a_slender == 0.0) {
    vec4 nearer = u_view_projection * vec4(v_world + to_eye * (min(0.8 * a_radius, 0.5 * away) / away), 1.0);
    gl_Position.z = nearer.z / nearer.w * gl_Position.w;
  }
  // Dust scatters light to all sides, on through itself and most of it onwards; a chip has one face to the sun, or not.
  if (a_slender > 0.0) {
    v_sunlight = lit(a_place, vec3(0.0)) * (0.25 + 0.6 * abs(sin(a_turn * 2.0)));
  } else {
    v_sunlight = mix(0.72, 1.0, lit(a_place + u_sun * a_radius * 1.5, vec3(0.0)));
    v_sunlight *= 1.0 + 0.4 * max(dot(to_eye, -u_sun) / away, 0.0);
  }
  v_albedo = a_colour.rgb;
  // Nothing covers the whole picture: what is close to the eye is thin.
  v_opacity = a_colour.a * (a_slender > 0.0 ? 1.0 : smoothstep(0.5, 3.0, away / max(a_radius, 1e-3)));
  v_turn = a_turn;
  v_slender = a_slender;
}
