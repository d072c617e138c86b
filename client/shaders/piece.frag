// What is seen of pieces, for raymarch_shade.frag: small triangles cost little so. Needs shape.glsl.
in vec3 v_world;
in float v_openness;
in vec2 v_worn;
flat in int v_look;
flat in float v_piece;
uniform vec3 u_eye;
out uvec4 o_hit;  // as of raymarch.frag; 2^31 | which piece; its look, openness and wear; its normal

uint bits(float value, float most) { return uint(clamp(value, 0.0, 1.0) * most + 0.5); }

void main() {
  // On the faces of an octahedron, which lie in a square (Cigolle et al. 2014).
  vec3 normal = shape_normal();
  normal /= abs(normal.x) + abs(normal.y) + abs(normal.z);
  vec2 flat_normal = normal.xy;
  if (normal.z < 0.0) flat_normal = (1.0 - abs(normal.yx)) * vec2(normal.x < 0.0 ? -1.0 : 1.0, normal.y < 0.0 ? -1.0 : 1.0);
  flat_normal = flat_normal * 0.5 + 0.5;
  o_hit = uvec4(floatBitsToUint(length(v_world - u_eye)), 0x80000000u | uint(v_piece),
                uint(v_look) | bits(v_openness, 255.0) << 8u | bits(v_worn.x + v_worn.y, 65535.0) << 16u,
                bits(flat_normal.x, 65535.0) | bits(flat_normal.y, 65535.0) << 16u);
}
