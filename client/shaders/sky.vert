// One triangle over the whole screen, at the far plane.
uniform mat4 u_inverse_view_projection;
uniform vec3 u_eye;
out vec3 v_direction;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  vec4 far = u_inverse_view_projection * vec4(corner, 1.0, 1.0);
  v_direction = far.xyz / far.w - u_eye;
  gl_Position = vec4(corner, 1.0, 1.0);
}
