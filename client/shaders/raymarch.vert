// One triangle over the whole screen.
uniform mat4 u_inverse_view_projection;
uniform vec3 u_eye;
uniform vec2 u_span;  // of the screen that the target covers: tiles may reach beyond it
out vec3 v_direction;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  vec2 on_screen = (corner + 1.0) * u_span - 1.0;
  vec4 far = u_inverse_view_projection * vec4(on_screen, 1.0, 1.0);
  v_direction = far.xyz / far.w - u_eye;
  gl_Position = vec4(corner, 1.0, 1.0);
}
