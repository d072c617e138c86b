// The sun's light through the shadow map (client/render/gl/shadow_map.h).

uniform mat4 u_shadow_matrix;  // world to shadow map, 0..1
uniform sampler2DShadow u_shadow_map;

// 0 in shadow, 1 in the light. `normal` of the shape, not of its grain.
float lit(vec3 world, vec3 normal) {
  vec3 p = (u_shadow_matrix * vec4(world + normal * 0.06, 1.0)).xyz;
  vec2 edge = abs(p.xy - 0.5) * 2.0;
  float inside = 1.0 - smoothstep(0.85, 1.0, max(edge.x, edge.y));
  if (inside <= 0.0 || p.z >= 1.0) return 1.0;
  float texel = 1.0 / float(textureSize(u_shadow_map, 0).x);
  float sum = 0.0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) sum += texture(u_shadow_map, vec3(p.xy + vec2(i, j) * texel, p.z - 0.0006));
  return mix(1.0, sum / 9.0, inside);
}
