// What a ray met, or a piece before it, or the sky. Needs march.glsl and rock.glsl; with PIECES, pieces.glsl.
uniform usampler2D u_hits;  // of raymarch.frag and piece.frag
uniform mat4 u_view_projection;
uniform bool u_bodies;  // there are pieces or props, and the shadow map is theirs
uniform float u_lift;   // metres: pieces are drawn in front of terrain that is so little nearer
in vec3 v_direction;
out vec4 o_colour;

#ifdef PIECES

vec3 normal_of(uint bits) {
  vec2 at = vec2(float(bits & 65535u), float(bits >> 16u)) / 65535.0 * 2.0 - 1.0;
  vec3 normal = vec3(at, 1.0 - abs(at.x) - abs(at.y));
  float under = max(-normal.z, 0.0);
  normal.x -= normal.x < 0.0 ? -under : under;
  normal.y -= normal.y < 0.0 ? -under : under;
  return normalize(normal);
}

// 1 on the ground, 0 in the air. Two levels up the field knows of ground that is four times as far away.
float dust_on(vec3 place, float radius_m) {
  int level = min(2, u_levels - 1);
  float above_m = field_at(place - u_eye, level) / u_voxels_per_m[level];
  return 1.0 - smoothstep(radius_m + 0.4, radius_m + 1.2, above_m);
}

#endif

// Whether the picture there is the sky.
bool is_sky(uvec4 hit, vec3 direction) {
  if (hit.y != 0u) return false;
  o_colour = vec4(tone(sky(direction)), 1.0);
  gl_FragDepth = 1.0;
  return true;
}

float depth_at(vec3 from_eye) {
  vec4 clip = u_view_projection * vec4(u_eye + from_eye, 1.0);
  return clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0);
}

void main() {
  vec3 direction = normalize(v_direction);
  uvec4 hit = texelFetch(u_hits, ivec2(gl_FragCoord.xy), 0);
  if (is_sky(hit, direction)) return;
  float along = uintBitsToFloat(hit.x);
  vec3 from_eye = direction * along;
  vec3 world = u_eye + from_eye;
  gl_FragDepth = depth_at(from_eye);
  int level = int(hit.y) - 1;
#ifdef PIECES
  bool is_piece = hit.y >= 0x80000000u;
  if (is_piece) level = level_of(from_eye, 0);
#endif
  bool is_loaded = level < u_levels;
  Look there = look(from_eye, min(level, u_levels - 1));
  bool is_stored = there.kind == kind_stored;
  vec3 normal = -direction;
  if (is_stored) normal = brick_normal(there.entry, there.local, normal);
  float above = band;  // how far it is to the own surface at the height of the probe, voxels
  vec2 worn = vec2(0.0);
  int material = 0;
  float before = 0.0;
  bool is_new = false;
#if SURFACES > 0
  if (is_stored) before = generated_in(there.entry, there.local, 0.0);
  is_new = before != 0.0;
  if (is_stored) material = look_at(there.entry, there.local, normal, before);
#endif
  // The ground's own frame of rock is the world's.
  vec3 in_rock = world, shape = normal;
#ifdef PIECES
  int piece = int(hit.y & 65535u);
  vec4 place = of_piece(piece, 0), rotation = of_piece(piece, 1);
  float dust = 1.0;
  if (is_piece) {
    // A stone that merged lies in the surface of the terrain that it became.
    gl_FragDepth = depth_at(direction * max(along - u_lift, 0.5 * along));
    in_rock = of_piece(piece, 3).xyz + rotated(vec4(-rotation.xyz, rotation.w), world - place.xyz);
    shape = normal_of(hit.w);
    normal = rotated(rotation, shape);
    material = int(hit.z & 255u);
    above = float((hit.z >> 8u) & 255u) / 255.0 * probe_height;
    dust = dust_on(place.xyz, of_piece(piece, 2).w);
    before = generated_in(there.entry, there.local, is_stored ? there.distance / band : there.kind == kind_solid ? -1.0 : 1.0);
    is_new = is_loaded;
  }
#endif
#if SURFACES > 0
  if (is_new) worn = worn_at(from_eye, normal, level, before, above);
#endif
#ifdef PIECES
  // On the ground a piece takes on the looks of what it is about to become.
  if (is_piece) worn = mix(vec2(float(hit.z >> 16u) / 65535.0, 0.0), worn, dust);
#endif
  float in_cleft = cleft_openness_at(from_eye, normal, level, above);
  float open = openness_at(from_eye, normal, level, in_cleft);
  Rock rock = rock_at(in_rock, shape, worn, material, in_cleft, along);
#ifdef PIECES
  if (is_piece) {
    rock.albedo *= 1.0 + piece_shade(material) * (place.w - 0.4) * (1.0 - dust);
    rock.normal = rotated(rotation, rock.normal);
  }
#endif
  float sunlight = max(dot(rock.normal, u_sun), 0.0);
  if (sunlight > 0.0 && is_loaded) sunlight *= sun_at(from_eye + normal * (0.5 / u_voxels_per_m[level]), u_sun, level);
  if (u_bodies && sunlight > 0.0) sunlight *= lit(world, normal);
  o_colour = vec4(tone(in_fog(lit_rock(rock, rock.normal, open * rock.open, sunlight, -direction), world, along)), 1.0);
}
