// Boxes about loose pieces (client/render/scene/contact.h), as far as they keep light away.

layout(location = 0) in vec4 a_contact;  // centre and radius

uniform mat4 u_view_projection;

flat out vec4 v_contact;

void main() {
  // Corners of a cube in the order of one strip, a bit each.
  vec3 corner = vec3((0x287A >> gl_VertexID) & 1, (0x02AF >> gl_VertexID) & 1, (0x31E3 >> gl_VertexID) & 1);
  v_contact = a_contact;
  gl_Position = u_view_projection * vec4(a_contact.xyz + (corner * 2.0 - 1.0) * a_contact.w * 2.5, 1.0);
}
