// What rock looks like in the light of atmosphere.glsl, the same for every way to draw it. Needs noise.glsl and the
// table of materials (client/render/gl/material_source.h).

uniform vec3 u_eye;
uniform float u_fog_m;  // distance at which fog hides nearly all
uniform float u_ice_above_m;

struct Rock {
  vec3 albedo;
  vec3 normal;  // bent by the grain
};

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
  vec3 ground = mix(rock, mix(sand, scrub, green), flatness);
  // Ice and old snow on the heights: where it is not too steep to lie, and in the cracks of the beds.
  float high = smoothstep(-0.9, 1.3, p.y - u_ice_above_m + 1.6 * (coarse.x - 0.5) + 0.5 * (fine - 0.5));
  float lies = smoothstep(0.30, 0.62, n.y + 0.20 * (fine - 0.5) + 0.10 * seam);
  vec3 ice = mix(vec3(0.50, 0.60, 0.68), vec3(0.80, 0.83, 0.86), smoothstep(0.35, 0.75, fine + 0.3 * n.y));
  return mix(ground, ice, high * lies);
}

// How much of broken rock, which is paler and warmer than what the weather has had, and of rubble, which lies dusty,
// shows where the field as generated was `before` (code / 127).
float cut_of(float before) { return smoothstep(-0.08, -0.40, before); }
float heap_of(float before) { return smoothstep(0.10, 0.45, before); }

// At p in the frame of the rock, whose patterns stay with a piece that moves. `away`: metres from the eye.
Rock rock_at(vec3 p, vec3 shape_normal, float cut, float heap, float away) {
  vec4 coarse = noise(p * 0.16);
  vec4 middle = noise(p * 1.3 + 17.0);
  vec4 small = noise(p * 5.1 + 5.0);
  float fine = 0.6 * middle.x + 0.4 * small.x;

  vec3 albedo = weathered(p, shape_normal, coarse, fine);
  float vein = smoothstep(0.46, 0.5, middle.x) * (1.0 - smoothstep(0.5, 0.54, middle.x));
  vec3 fresh = mix(vec3(0.62, 0.33, 0.155), vec3(0.80, 0.53, 0.30), fine) * (1.0 - 0.18 * vein);
  vec3 rubble = mix(vec3(0.44, 0.26, 0.145), vec3(0.62, 0.41, 0.245), fine);
  albedo = mix(albedo, fresh, cut);
  albedo = mix(albedo, rubble, heap);

  // Grain: the noise's slope bends the normal, less with distance, where it would only flicker.
  float grain = 1.0 / (1.0 + away * 0.05);
  vec3 bump = middle.yzw * 0.16 + small.yzw * 0.11 * grain;
  return Rock(albedo, normalize(shape_normal - (bump - shape_normal * dot(bump, shape_normal)) * grain));
}

// A material, by its number, lends its colour to the grain of what lies there.
vec3 of_material(int material, vec3 albedo) {
  float grain = 0.55 + 1.1 * dot(albedo, vec3(0.3, 0.5, 0.2));
  return material_albedo[material - 1] * grain;
}

// `paint`: a paint number, of the brick's paint or of the layer that shows as far as there is a cut.
vec3 painted(vec3 albedo, int paint, float cut) {
  if (paint == 0) return albedo;
  if (paint < paint_in_cuts) return of_material(paint, albedo);
  return mix(albedo, of_material(paint - paint_in_cuts, albedo), cut);
}

// `sunlight`: cosine of the sun's angle, 0 in shadow. `openness`: 1 under the open sky, less in a crevice.
vec3 lit_rock(vec3 albedo, vec3 normal, float openness, float sunlight) {
  float open = mix(1.0, openness, 0.85);
  open = open * open;
  // What the rock around reflects: most in a crevice, and of the rock's own colour.
  vec3 bounce = sun_colour * albedo * (0.05 + 0.14 * (1.0 - open));
  return albedo * (sun_colour * sunlight + ambient(normal) * open + bounce);
}

vec3 in_fog(vec3 colour, vec3 world, float away) {
  float fog = 1.0 - exp(-pow(away / (u_fog_m * 0.80), 4.5));
  vec3 view = (world - u_eye) / max(away, 1e-3);
  return mix(colour, sky(normalize(vec3(view.x, max(view.y, 0.0), view.z))), fog);
}
