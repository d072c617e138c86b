// Grass, bushes and stones, an instance each (client/render/details/detail.h). STONES says which. CASTS: for the shadow
// map, which must not be read while it is drawn.

layout(location = 0) in vec3 a_position;  // parts of the size
layout(location = 1) in vec4 a_normal;    // w: how bright
layout(location = 2) in vec4 a_place;     // metres; w: size
layout(location = 3) in vec4 a_colour;    // square roots of linear light; w: sun and sky
layout(location = 4) in vec4 a_turn;      // w: part of the range

uniform mat4 u_view_projection;
uniform float u_range_m;
uniform float u_wind_s;  // the wind's time; 0: it is still
uniform float u_pixel;   // metres that it covers at one metre; 0: it draws no blades

#if !CASTS

// At the surface of the shadow map once: there are many, and they are small.
float lit_once(vec3 world) {
  vec3 p = (u_shadow_matrix * vec4(world, 1.0)).xyz;
  if (max(abs(p.x - 0.5), abs(p.y - 0.5)) > 0.46 || p.z >= 1.0) return 1.0;
  return texture(u_shadow_map, vec3(p.xy, p.z - 0.0008));
}

#endif

#if STONES

out vec3 v_world;
out vec3 v_rock;
flat out vec3 v_tint;
flat out float v_open;
flat out float v_sunlight;

#else

uniform vec3 u_soil_tint;

out vec3 v_colour;

#endif

void main() {
  float light = floor(a_colour.w * 255.0 + 0.5);
  float sunlit = floor(light / 16.0) / 15.0, open = mod(light, 16.0) / 15.0;
  float away = length(a_place.xyz - u_eye);
  float size = a_place.w * (1.0 - smoothstep(0.75, 1.0, away / (u_range_m * a_turn.w)));
  vec3 albedo = a_colour.rgb * a_colour.rgb;
#if STONES
  vec4 turn = vec4(a_turn.xyz, sqrt(max(1.0 - dot(a_turn.xyz, a_turn.xyz), 0.0)));
  vec3 off = rotated(turn, a_position * size);
  // It lies on its flat side, and a little in the ground.
  v_world = a_place.xyz + vec3(off.x, 0.75 * off.y + 0.12 * size, off.z);
  v_rock = a_position * a_place.w + a_place.xyz;
  v_tint = 2.0 * albedo;
  v_open = open;
  v_sunlight = sunlit;
  gl_Position = u_view_projection * vec4(v_world, 1.0);
#else
  float angle = 3.14159 * a_turn.x, c = cos(angle), s = sin(angle);
  vec3 p = vec3(c * a_position.x - s * a_position.z, a_position.y, s * a_position.x + c * a_position.z) * size;
  vec3 normal = vec3(c * a_normal.x - s * a_normal.z, a_normal.y, s * a_normal.x + c * a_normal.z);
  if (u_pixel > 0.0) {
    // The normals of blades are the ways from their middles to their edges: none is so thin that pixels miss it.
    p += normal * (max(0.55 * u_pixel * away - 0.027 * size, 0.0) * min(2.0 * size / a_place.w, 1.0));
    normal = vec3(0.0, 1.0, 0.0);
  }
  // Its foot follows the ground's slope.
  vec2 slope = a_turn.yz;
  float up = sqrt(max(1.0 - dot(slope, slope), 0.25));
  p.y -= dot(slope, p.xz) / up;
  normal = normalize(normal + vec3(slope.x, 0.0, slope.y) * 0.5);
  // Gusts go over the land, in the wind's direction; what is high bends.
  float gust = sin(1.1 * u_wind_s - dot(a_place.xz, vec2(0.30, 0.17))) * sin(0.37 * u_wind_s - 0.11 * a_place.x);
  float sway = sin(4.3 * u_wind_s + 1.7 * a_place.x + 2.3 * a_place.z);
  p.xz += vec2(0.87, 0.49) * (a_position.y * a_position.y * size * step(0.0001, u_wind_s) * (0.10 * gust + 0.035 * sway));
  vec3 world = a_place.xyz + p;
#if !CASTS
  float sunlight = max(dot(normal, u_sun), 0.0) * sunlit;
  if (sunlight > 0.0) sunlight *= lit_once(world + vec3(0.0, 0.05, 0.0));
  albedo *= u_soil_tint * a_normal.w;
  vec3 lit_colour = albedo * (sun_colour * sunlight + ambient(normal) * open * open * a_normal.w);
  v_colour = in_fog(lit_colour, world, away);
#endif
  gl_Position = u_view_projection * vec4(world, 1.0);
#endif
}
