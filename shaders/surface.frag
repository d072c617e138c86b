in vec3 v_world;
in vec3 v_rock;
in vec3 v_normal;
in vec3 v_rock_normal;
in float v_openness;
in float v_before;

uniform vec3 u_eye;
uniform float u_fog_m;             // distance at which fog hides nearly all
uniform vec4 u_rotation;
uniform float u_loose;             // 1 for a piece, 0 for terrain
uniform float u_tint;              // 0..1, of a piece
uniform mat4 u_shadow_matrix;      // world to shadow map, 0..1
uniform sampler2DShadow u_shadow_map;

out vec4 o_colour;

vec3 rotate(vec3 v) {
  vec3 t = 2.0 * cross(u_rotation.xyz, v);
  return v + u_rotation.w * t + cross(u_rotation.xyz, t);
}

// Beds of sandstone, bent a little; scrub and sand where it is flat.
vec3 weathered(vec3 p, vec3 n, vec4 coarse, float fine) {
  float height = p.y + 2.6 * (coarse.x - 0.5);
  float bed = noise_1d(height * 0.75, 3);
  float seam = noise_1d(height * 3.1, 7);
  vec3 rock = mix(vec3(0.29, 0.125, 0.065), vec3(0.47, 0.265, 0.145), smoothstep(0.25, 0.80, bed));
  rock = mix(rock, vec3(0.60, 0.43, 0.29), 0.50 * smoothstep(0.70, 0.92, seam));
  rock *= 0.80 + 0.40 * fine;
  vec3 sand = vec3(0.50, 0.35, 0.215) * (0.86 + 0.28 * fine);
  vec3 scrub = vec3(0.165, 0.172, 0.075) * (0.70 + 0.60 * fine);
  float flatness = smoothstep(0.72, 0.90, n.y + 0.12 * (fine - 0.5));
  float green = smoothstep(0.42, 0.66, coarse.x + 0.22 * (fine - 0.5) + 0.006 * p.y);
  return mix(rock, mix(sand, scrub, green), flatness);
}

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

void main() {
  vec3 rock_normal = normalize(v_rock_normal);
  float away = length(v_world - u_eye);
  vec4 coarse = noise(v_rock * 0.16);
  vec4 middle = noise(v_rock * 1.3 + 17.0);
  vec4 small = noise(v_rock * 5.1 + 5.0);
  float fine = 0.6 * middle.x + 0.4 * small.x;

  // Broken rock is paler and warmer than what the weather has had; what came to rest lies dusty.
  float cut = smoothstep(-0.08, -0.40, v_before);
  float heap = smoothstep(0.10, 0.45, v_before);
  vec3 albedo = weathered(v_rock, rock_normal, coarse, fine);
  float vein = smoothstep(0.46, 0.5, middle.x) * (1.0 - smoothstep(0.5, 0.54, middle.x));
  vec3 fresh = mix(vec3(0.62, 0.33, 0.155), vec3(0.80, 0.53, 0.30), fine) * (1.0 - 0.18 * vein);
  vec3 rubble = mix(vec3(0.44, 0.26, 0.145), vec3(0.62, 0.41, 0.245), fine);
  albedo = mix(albedo, fresh, cut);
  albedo = mix(albedo, rubble, heap);
  albedo *= 1.0 + u_loose * 0.22 * (u_tint - 0.4);

  // Grain: the noise's slope bends the normal, less with distance, where it would only flicker.
  float grain = 1.0 / (1.0 + away * 0.05);
  vec3 bump = middle.yzw * 0.16 + small.yzw * 0.11 * grain;
  vec3 normal = normalize(rotate(normalize(rock_normal - (bump - rock_normal * dot(bump, rock_normal)) * grain)));

  float open = mix(1.0, v_openness, 0.85);
  open = open * open;
  float sun = max(dot(normal, u_sun), 0.0);
  if (sun > 0.0) sun *= lit(v_world, normalize(v_normal));
  // What the rock around reflects: most in a crevice, and of the rock's own colour.
  vec3 bounce = sun_colour * albedo * (0.05 + 0.14 * (1.0 - open));
  vec3 light = sun_colour * sun + ambient(normal) * open + bounce;
  vec3 colour = albedo * light;

  float fog = 1.0 - exp(-pow(away / (u_fog_m * 0.80), 4.5));
  vec3 view = (v_world - u_eye) / max(away, 1e-3);
  colour = mix(colour, sky(normalize(vec3(view.x, max(view.y, 0.0), view.z))), fog);
  o_colour = vec4(tone(colour), 1.0);
}
