// How much of the sky a ball hides from a place beside it: the cosine at which it stands there, times its share of the
// half sphere (Quilez, "sphere ambient occlusion"). What faces away from it, as the piece itself does, is as it was.

uniform mat4 u_inverse_view_projection;
uniform vec3 u_eye;
uniform highp sampler2D u_depth;

flat in vec4 v_contact;

out vec4 o_colour;

void main() {
  vec2 size = vec2(textureSize(u_depth, 0));
  ivec2 at = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(u_depth, at, 0).r;
  if (depth >= 1.0) discard;
  // Its neighbours, inwards: derivatives of neighbouring fragments would mix boxes and what lies behind an outline.
  ivec2 beside = ivec2(at.x > 0 ? -1 : 1, at.y > 0 ? -1 : 1);
  vec3 place[3];
  for (int i = 0; i < 3; ++i) {
    ivec2 texel = at + ivec2(i == 1 ? beside.x : 0, i == 2 ? beside.y : 0);
    vec4 p = u_inverse_view_projection *
             vec4(vec3((vec2(texel) + 0.5) / size, i == 0 ? depth : texelFetch(u_depth, texel, 0).r) * 2.0 - 1.0, 1.0);
    place[i] = p.xyz / p.w;
  }
  vec3 away = v_contact.xyz - place[0];
  float reach = 2.5 * v_contact.w, far = length(away);
  if (far >= reach || far < 1e-4) discard;
  vec3 normal = normalize(cross(place[1] - place[0], place[2] - place[0]));
  if (dot(normal, u_eye - place[0]) < 0.0) normal = -normal;
  float share = min(v_contact.w * v_contact.w / (far * far), 1.0);
  float hidden = max(dot(normal, away / far), 0.0) * share * (1.0 - smoothstep(0.6 * reach, reach, far));
  o_colour = vec4(vec3(1.0 - 0.62 * hidden), 1.0);
}
