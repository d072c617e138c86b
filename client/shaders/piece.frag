uniform float u_lift;  // metres: drawn in front of terrain that is so little nearer
out vec4 o_colour;

void main() {
  PieceHit hit = march_piece();
  if (!hit.found) discard;
  vec3 from_eye = hit.world - u_eye;
  // A stone that merged lies in the surface of the terrain that it became.
  gl_FragDepth = depth_of(u_eye + from_eye * max(1.0 - u_lift / max(length(from_eye), 1e-3), 0.5));
  float away = length(from_eye);
  float voxel_m = 1.0 / u_voxels_per_m[0];
  vec3 local_normal = rotated(unturned(), -from_eye / max(away, 1e-3));
  float before = 0.0;
  int material = 0;
  if (hit.entry.x != 0u) {
    local_normal = brick_normal(hit.entry, hit.in_brick, local_normal);
    before = generated_in(hit.entry, hit.in_brick, 0.0);
    material = look_at(hit.entry, hit.in_brick, local_normal, before);
  }
  vec3 normal = rotated(v_rotation, local_normal);
  // On the ground it takes on the looks of what it is about to become.
  float above = piece_at(hit.local + local_normal * probe_height);
  vec2 there = worn_at(from_eye, normal, 0, generated_at(from_eye, 0), above);
  vec2 worn = mix(vec2(max(-before, 0.0), max(before, 0.0)), there, v_dust);
  int level = level_of(from_eye, 0);
  float in_cleft = cleft_openness_at(from_eye, normal, level, above);
  Rock rock = rock_at((v_origin + hit.local) * voxel_m, local_normal, worn, material, in_cleft, away);
  rock.albedo *= 1.0 + piece_shade(material) * (v_tint - 0.4) * (1.0 - v_dust);
  vec3 bent = normalize(rotated(v_rotation, rock.normal));
  float sunlight = max(dot(bent, u_sun), 0.0);
  if (level < u_levels && sunlight > 0.0) sunlight *= sun_at(from_eye + normal * (0.5 * voxel_m), u_sun, level);
  if (sunlight > 0.0) sunlight *= lit(hit.world, normal);
  o_colour = vec4(tone(in_fog(lit_rock(rock, bent, openness_at(from_eye, normal, level, in_cleft) * rock.open, sunlight, -from_eye / max(away, 1e-3)), hit.world, away)), 1.0);
}
