// Where the ray of each pixel ends, unless a piece is nearer; raymarch_shade.frag draws it.
uniform usampler2D u_tiles;
uniform int u_tile;
uniform float u_pixel;  // metres a pixel covers at one metre
uniform mat4 u_inverse_view_projection;
uniform vec3 u_eye;
uniform bool u_are_pieces;
uniform highp sampler2D u_pieces_depth;
in vec3 v_direction;
out uvec4 o_hit;  // how far along it, metres, as bits; 1 + the level

// How far a piece is, metres.
float nearest_piece(ivec2 at) {
  float depth = texelFetch(u_pieces_depth, at, 0).r;
  if (depth == 1.0) return 1e9;
  vec2 on_screen = (vec2(at) + 0.5) / vec2(textureSize(u_pieces_depth, 0));
  vec4 there = u_inverse_view_projection * vec4(vec3(on_screen, depth) * 2.0 - 1.0, 1.0);
  return length(there.xyz / there.w - u_eye);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float start = uintBitsToFloat(texelFetch(u_tiles, at / u_tile, 0).r);
  float end = u_are_pieces ? nearest_piece(at) : 1e9;
  Hit hit;
  hit.found = false;
  if (start >= 0.0) hit = march(vec3(0.0), normalize(v_direction), start, end, u_pixel);
  if (!hit.found) discard;
  o_hit = uvec4(floatBitsToUint(hit.along), uint(hit.level) + 1u, 0u, 0u);
}
