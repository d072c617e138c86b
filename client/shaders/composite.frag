// Brings another target's picture into this one, with its depth, so that what is drawn next lies right in it. Edges are
// smoothed by what they look like, because a ray has one pixel: colours are mixed along an edge, as far as the picture
// changes across it (after FXAA, Lottes 2009).
uniform sampler2D u_colour;
uniform sampler2D u_depth;
uniform vec2 u_texel;   // of this target: 1 / its size
uniform vec2 u_source;  // of the other one
out vec4 o_colour;

float luma(vec3 colour) { return dot(colour, vec3(0.299, 0.587, 0.114)); }

vec3 smoothed(vec2 at) {
  vec3 here = texture(u_colour, at).rgb;
  float middle = luma(here);
  float a = luma(texture(u_colour, at + vec2(-0.5, -0.5) * u_source).rgb);
  float b = luma(texture(u_colour, at + vec2(0.5, -0.5) * u_source).rgb);
  float c = luma(texture(u_colour, at + vec2(-0.5, 0.5) * u_source).rgb);
  float d = luma(texture(u_colour, at + vec2(0.5, 0.5) * u_source).rgb);
  float least = min(middle, min(min(a, b), min(c, d)));
  float most = max(middle, max(max(a, b), max(c, d)));
  if (most - least < max(0.035, 0.11 * most)) return here;
  vec2 along = vec2(c + d - a - b, a + c - b - d);
  float smaller = max(min(abs(along.x), abs(along.y)) + 0.03 * (a + b + c + d), 0.008);
  along = clamp(along / smaller, -4.0, 4.0) * u_source;
  vec3 near = 0.5 * (texture(u_colour, at + along * -0.1667).rgb + texture(u_colour, at + along * 0.1667).rgb);
  vec3 far = 0.5 * near + 0.25 * (texture(u_colour, at - 0.5 * along).rgb + texture(u_colour, at + 0.5 * along).rgb);
  float found = luma(far);
  return found < least || found > most ? near : far;
}

void main() {
  vec2 at = gl_FragCoord.xy * u_texel;
  o_colour = vec4(smoothed(at), 1.0);
  gl_FragDepth = texture(u_depth, at).r;
}
