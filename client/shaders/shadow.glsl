// The sun's light through the shadow map (client/render/gl/shadow_map.h).

uniform mat4 u_shadow_matrix;  // world to shadow map, 0..1
uniform sampler2DShadow u_shadow_map;
uniform int u_shadow_samples;  // a pixel: 9, 1, or 0, where nothing casts a shadow

// 0 in shadow, 1 in the light. `normal` of the shape, not of its grain.
float lit(vec3 world, vec3 normal) {
  vec3 p = (u_shadow_matrix * vec4(world + normal * 0.06, 1.0)).xyz;
  vec2 edge = abs(p.xy - 0.5) * 2.0;
  float inside = 1.0 - smoothstep(0.85, 1.0, max(edge.x, edge.y));
  if (inside <= 0.0 || p.z >= 1.0) return 1.0;
  float texel = 1.0 / float(textureSize(u_shadow_map, 0).x);
  // A number that compilers do not know: they would unroll the loop, which a processor that draws then cannot leave.
  float sum = 0.0;
  for (int i = 0; i < u_shadow_samples; ++i) {
    vec2 off = u_shadow_samples > 1 ? vec2(i / 3 - 1, i % 3 - 1) : vec2(0.0);
    sum += texture(u_shadow_map, vec3(p.xy + off * texel, p.z - 0.0006));
  }
  return mix(1.0, sum / float(max(u_shadow_samples, 1)), inside);
}
