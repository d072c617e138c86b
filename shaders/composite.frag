// Brings another target's picture into this one, with its depth, so that what is drawn next lies right in it.
uniform sampler2D u_colour;
uniform sampler2D u_depth;
uniform vec2 u_texel;  // of this target: 1 / its size
out vec4 o_colour;

void main() {
  vec2 at = gl_FragCoord.xy * u_texel;
  o_colour = vec4(texture(u_colour, at).rgb, 1.0);
  gl_FragDepth = texture(u_depth, at).r;
}
