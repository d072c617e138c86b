// What surfaces look like in the light of atmosphere.glsl, the same for every way to draw them. Needs haze.glsl and
// material.glsl.

uniform float u_ice_above_m;
// What a palette makes of the colours below (client/render/scene/ground_tint.h).
uniform vec3 u_bulk_tint, u_soil_tint, u_cap_tint;

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
  vec3 ground = mix(rock * u_bulk_tint, mix(sand, scrub, green) * u_soil_tint, flatness);
  // Ice and old snow on the heights: where it is not too steep to lie, and in the cracks of the beds.
  float high = smoothstep(-0.9, 1.3, p.y - u_ice_above_m + 1.6 * (coarse.x - 0.5) + 0.5 * (fine - 0.5));
  float lies = smoothstep(0.30, 0.62, n.y + 0.20 * (fine - 0.5) + 0.10 * seam);
  vec3 ice = mix(vec3(0.50, 0.60, 0.68), vec3(0.80, 0.83, 0.86), smoothstep(0.35, 0.75, fine + 0.3 * n.y));
  return mix(ground, ice * u_cap_tint, high * lies);
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

// How much of its shade a loose piece has of its own, with that look: made things are all alike.
float piece_shade(int look) { return look > 0 ? 0.08 : 0.22; }

#if SURFACES > 0

// One of the stones of rubble: planes that turn the light each its own way, round its edge, and the joint about it. `gap`:
// what others take of its edge. `edge` becomes how far it is to the edge that is left.
Rock stone_of(vec3 q, vec3 n, vec3 bed, vec3 bent, float fine, float gap, float pixel, out float edge) {
  Stone stone = stone_at(q + bent * 0.07);
  edge = stone.edge - gap;
  float near = 1.0 - smoothstep(0.25, 0.9, pixel);
  // Stones touch here and there: joints are not equally wide.
  float width = 0.02 + 0.06 * smoothstep(0.30, 0.75, fine);
  float deep = (1.0 - smoothstep(0.3 * width, width + pixel, edge)) * near;
  float rim = 1.0 - smoothstep(0.0, 0.24, edge);
  vec4 face = facet(q * 1.25 + stone.way * 9.0, bent * 0.06);
  vec3 bulge = -0.9 * stone.off - 1.7 * rim * rim * stone.joint;
  vec3 bump = stone.way * 1.1 + face.xyz + bulge + bent * 0.14;
  vec3 tint = mix(vec3(0.82, 0.87, 0.94), vec3(1.15, 0.96, 0.80), smoothstep(0.15, 0.85, stone.way.y + 0.5));
  float shade = (0.66 + 0.70 * (stone.way.z + 0.5)) * (0.62 + 0.76 * fine);
  Rock rock;
  rock.albedo = bed * tint * shade * mix(1.0, 0.80, rim * rim * near) * mix(1.0, 0.55, deep);
  rock.normal = n - (bump - n * dot(bump, n)) * near;
  rock.open = 1.0 - 0.15 * rim * near - 0.30 * deep;
  rock.roughness = 1.0;
  return rock;
}

// Rubble: stones up to 80 cm large, and small ones in the gaps between them. `bed`: the colour of a broken face;
// `bent`: slopes of the noise, which keep faces from being even; `sand`: brightness by grains of sand.
Rock rubble_at(vec3 p, vec3 n, vec3 bed, vec3 bent, float fine, float sand, float in_cleft, float away) {
  vec3 q = along_beds * p;
  // More small ones where the surface turns in.
  float gap = 0.07 + 0.22 * (1.0 - in_cleft) + 0.16 * (fine - 0.5);
  float edge, small_edge;
  Rock large = stone_of(q * 1.35, n, bed, bent, fine, gap, 0.0018 * away, edge);
  Rock small = stone_of(q * 3.6 + 7.0, n, bed * 0.86, bent * 0.6, fine, 0.0, 0.005 * away, small_edge);
  float filled = 1.0 - smoothstep(-0.02, 0.02, edge);
  Rock rock;
  rock.albedo = mix(large.albedo, small.albedo, filled) * (sand * mix(0.55, 1.0, smoothstep(0.1, 0.8, in_cleft)));
  rock.normal = mix(large.normal, small.normal, filled);
  rock.open = mix(large.open, small.open * 0.8, filled);
  rock.roughness = 1.0;
  return rock;
}

#endif

// At p in the frame of the rock, whose patterns stay with a piece that moves. `worn`: how far the field as generated was
// from here, x where rock has gone, y where it has come. `look`: 0, or 1 + a row of the palette. `in_cleft`: 1 on an open
// face, less where other rock is near above it. `away`: metres from the eye.
Rock rock_at(vec3 p, vec3 shape_normal, vec2 worn, int look, float in_cleft, float away) {
  vec4 coarse = noise(p * 0.16);
  vec4 middle = noise(p * 1.3 + 17.0);
  vec4 small = noise(p * 5.1 + 5.0);
#if SURFACES > 0
  bool heaped = look > 0 && is_rubble(look);
  if (look > 0 && !heaped) return material_at(look, p, shape_normal, coarse, middle, small, away);
#endif
  float fine = 0.6 * middle.x + 0.4 * small.x;
  float uneven = fine;
  float bare = bare_of(worn.x + worn.y, fine);
  float grain = 1.0 / (1.0 + away * 0.05);
  vec3 bump = middle.yzw * 0.17 + small.yzw * 0.15 * grain;
  float open = 1.0;

  // Grain of sand, where a pixel can show it.
  // In a loop, which a processor that draws leaves where no pixel beside it goes on: dust is for near ones.
  float near = 1.0 - smoothstep(6.0, 18.0, away), dusty = 1.0 - smoothstep(2.0, 6.0, away);
  int grains = dusty > 0.0 ? 2 : near > 0.0 ? 1 : 0;
  for (int i = 0; i < grains; ++i) {
    vec4 sand = noise(p * (i == 0 ? 23.0 : 71.0) + (i == 0 ? 3.0 : 9.0));
    bump += sand.yzw * ((i == 0 ? 0.17 : 0.10 * dusty) * near);
    fine += (i == 0 ? 0.30 : 0.16 * dusty) * (sand.x - 0.5) * near;
  }

#if SURFACES > 0
  if (heaped) {
    vec3 bed = texelFetch(u_materials, ivec2(look - 1, 0), 0).rgb * mix(0.85, 1.15, coarse.x);
    Rock rubble = rubble_at(p, shape_normal, bed, middle.yzw, uneven, 1.0 + fine - uneven, in_cleft, away);
    rubble.normal = normalize(rubble.normal);
    return rubble;
  }
#endif

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
    albedo = mix(albedo, broken * u_bulk_tint, bare);
  }
  // The slopes bend the normal, less with distance, where they would only flicker.
  Rock rock = Rock(albedo, normalize(shape_normal - (bump - shape_normal * dot(bump, shape_normal)) * grain), open, 1.0);
  return rock;
}

#if SURFACES > 0

// What a smooth surface mirrors of the sun and of the sky (Blinn 1977, with Schlick's approximation of Fresnel).
vec3 mirrored(float roughness, vec3 normal, vec3 to_eye, float openness, float sunlight) {
  float gloss = 1.0 - roughness;
  float facing = clamp(dot(normal, to_eye), 0.0, 1.0);
  float straight = mix(0.04, 0.30, smoothstep(0.4, 0.75, gloss));
  float share = straight + (1.0 - straight) * pow(1.0 - facing, 5.0);
  float power = exp2(1.0 + 8.0 * gloss);
  float peak = pow(max(dot(normal, normalize(u_sun + to_eye)), 0.0), power) * (power + 8.0) / 25.0;
  vec3 back = reflect(-to_eye, normal);
  vec3 around = mix(ground_colour * 0.6, sky(back), smoothstep(-0.15, 0.15, back.y));
  return (sun_colour * min(sunlight * peak, 3.0) + around * openness) * share * gloss * gloss;
}

#endif

// `sunlight`: cosine of the sun's angle, 0 in shadow. `openness`: 1 under the open sky, less in a crevice.
// `normal` in the world; `to_eye`: unit.
vec3 lit_rock(Rock rock, vec3 normal, float openness, float sunlight, vec3 to_eye) {
  float open = mix(1.0, openness, 0.85);
  open = open * open;
  // What the rock around reflects: most in a crevice, and of the rock's own colour.
  vec3 bounce = sun_colour * rock.albedo * (0.05 + 0.14 * (1.0 - open));
  vec3 light = rock.albedo * (sun_colour * sunlight + ambient(normal) * open + bounce);
#if SURFACES > 0
  if (rock.roughness < 1.0) light += mirrored(rock.roughness, normal, to_eye, open, sunlight);
#endif
  return light;
}
