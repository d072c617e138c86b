// What rock looks like in the light of atmosphere.glsl, the same for every way to draw it. Needs haze.glsl and the
// table of materials (client/render/gl/material_source.h).

uniform float u_ice_above_m;
uniform float u_soil_below_m;

struct Rock {
  vec3 albedo;
  vec3 normal;  // bent by the grain
  float open;   // 1, less in a crack
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

// How much shows of broken rock, cut or heaped, which is paler and warmer than what the weather has had, and bare. `worn`:
// how far the field as generated was from what lies here now, code / 127; 0 on the ground as it was.
float bare_of(float worn, float fine) { return smoothstep(0.08, 0.22, worn * (0.5 + fine)); }

// Turned, so that no face lies along the voxels, and flattened: rock splits along its beds.
const mat3 along_beds = mat3(0.82, 0.51, -0.31, -0.48, 1.32, 0.36, 0.37, -0.26, 0.88);

// What the dirt in a cleft leaves of the colour of broken rock.
const vec3 cleft_tint = vec3(0.46, 0.38, 0.33);

// One face of broken rock: which way it is bent, and how far its edge is, in cells of the lattice. Cells of a
// body-centred lattice have 14 faces and no direction of their own; `bend` makes them uneven.
vec4 facet(vec3 p, vec3 bend) {
  vec3 q = p + bend;
  vec3 a = floor(q + 0.5), b = floor(q) + 0.5;
  vec3 to_a = q - a, to_b = q - b;
  float apart = dot(to_a, to_a) - dot(to_b, to_b);
  ivec3 cell = ivec3((apart < 0.0 ? a : b) * 2.0);
  vec3 way = vec3(lattice(cell), lattice(cell + ivec3(7919, 0, 0)), lattice(cell + ivec3(0, 7919, 0))) - 0.5;
  return vec4(way, abs(apart));
}

// A material lends its colour to the grain of what lies there.
vec3 of_material(vec3 colour, vec3 albedo) { return colour * (0.25 + 1.15 * dot(albedo, vec3(0.3, 0.5, 0.2))); }

// Soil and ice, as far as a cut lays their layers bare.
vec3 layered(vec3 albedo, float height_m, float layer_m, float bare) {
  float shown = bare * smoothstep(0.04, 0.26, layer_m);
  if (shown <= 0.0) return albedo;
  float soil = 1.0 - smoothstep(u_soil_below_m - 0.4, u_soil_below_m, height_m);
  vec3 colour = height_m < u_soil_below_m ? material_albedo[material_soil - 1] : material_albedo[material_ice - 1];
  return mix(albedo, of_material(colour, albedo), shown * (height_m < u_soil_below_m ? soil : 1.0));
}

// At p in the frame of the rock, whose patterns stay with a piece that moves. `layer_m`: within the ground's layer;
// `paint`: colour of the painted part, and how much is painted; `in_cleft`: 1 on an open face, less where other rock is near
// above it; `away`: metres from the eye.
Rock rock_at(vec3 p, vec3 shape_normal, float worn, float layer_m, vec4 paint, float in_cleft, float away) {
  vec4 coarse = noise(p * 0.16);
  vec4 middle = noise(p * 1.3 + 17.0);
  vec4 small = noise(p * 5.1 + 5.0);
  float fine = 0.6 * middle.x + 0.4 * small.x;
  float bare = bare_of(worn, fine);
  float grain = 1.0 / (1.0 + away * 0.05);
  vec3 bump = middle.yzw * 0.17 + small.yzw * 0.15 * grain;
  float open = 1.0;

  // Grain of sand, where a pixel can show it.
  float near = 1.0 - smoothstep(6.0, 18.0, away);
  if (near > 0.0) {
    vec4 sand = noise(p * 23.0 + 3.0);
    vec4 dust = noise(p * 71.0 + 9.0);
    bump += (sand.yzw * 0.17 + dust.yzw * 0.10 * (1.0 - smoothstep(2.0, 6.0, away))) * near;
    fine += (0.30 * (sand.x - 0.5) + 0.16 * (dust.x - 0.5)) * near;
  }

  vec3 albedo = weathered(p, shape_normal, coarse, fine);
  if (bare > 0.0) {
    vec3 bed = mix(vec3(0.43, 0.20, 0.09), vec3(0.56, 0.335, 0.18), noise_1d(0.75 * p.y + 1.95 * (coarse.x - 0.5), 3));
    // Dust lies on what is flat.
    vec3 broken = mix(bed, vec3(0.50, 0.33, 0.20), smoothstep(0.25, 0.85, shape_normal.y)) * (0.52 + 1.05 * fine);
    // Dirt in the clefts: where stones touch, their outlines are dark in the sun, too.
    broken *= mix(cleft_tint, vec3(1.0), smoothstep(0.2, 0.95, in_cleft));
    // It breaks along faces: large ones with cracks between them, and chips on these.
    float seen = bare * (1.0 - smoothstep(30.0, 70.0, away));
    if (seen > 0.0) {
      vec3 q = along_beds * p;
      vec4 large = facet(q * 1.25, middle.yzw * 0.30 + coarse.yzw * 0.3);
      vec4 chip = facet(q * 3.7 + 0.4, small.yzw * 0.22 + middle.yzw * 0.5);
      bump += (large.xyz * 1.30 + chip.xyz * 0.65 * grain) * seen;
      float width = 0.02 + 0.004 * away;
      float crack = (1.0 - smoothstep(0.0, width, large.w)) * smoothstep(0.60, 0.74, 0.45 * coarse.x + 0.45 * middle.x + 0.35 * small.x);
      crack *= seen * min(1.0, 0.04 / width);
      broken *= (1.0 + 0.14 * large.x + 0.12 * chip.y) * (1.0 - 0.60 * crack);
      open -= 0.4 * crack;
    }
    albedo = mix(albedo, broken, bare);
  }
  albedo = layered(albedo, p.y, layer_m, bare);
  if (paint.a > 0.0)
    albedo = mix(albedo, of_material(paint.rgb / paint.a, albedo), smoothstep(0.3, 0.7, paint.a));

  // The slopes bend the normal, less with distance, where they would only flicker.
  return Rock(albedo, normalize(shape_normal - (bump - shape_normal * dot(bump, shape_normal)) * grain), open);
}

// `sunlight`: cosine of the sun's angle, 0 in shadow. `openness`: 1 under the open sky, less in a crevice.
vec3 lit_rock(vec3 albedo, vec3 normal, float openness, float sunlight) {
  float open = mix(1.0, openness, 0.85);
  open = open * open;
  // What the rock around reflects: most in a crevice, and of the rock's own colour.
  vec3 bounce = sun_colour * albedo * (0.05 + 0.14 * (1.0 - open));
  return albedo * (sun_colour * sunlight + ambient(normal) * open + bounce);
}
