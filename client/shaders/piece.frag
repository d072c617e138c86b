out vec4 o_colour;

void main() {
  PieceHit hit = march_piece();
  if (!hit.found) discard;
  gl_FragDepth = depth_of(hit.world);
  vec3 from_eye = hit.world - u_eye;
  float away = length(from_eye);
  float voxel_m = 1.0 / u_voxels_per_m[0];
  vec3 local_normal = rotated(unturned(), -from_eye / max(away, 1e-3));
  float before = 0.0;
  if (hit.entry.x != 0u) {
    vec3 slope = brick_gradient(hit.entry.x, hit.in_brick);
    if (dot(slope, slope) > 0.0) local_normal = normalize(slope);
    before = generated_in(hit.entry, hit.in_brick, 0.0);
  }
  vec3 normal = rotated(v_rotation, local_normal);
  // On the ground it takes on the looks of what it is about to become.
  float above = piece_at(hit.local + local_normal * probe_height);
  float there = worn_at(from_eye, normal, 0, generated_at(from_eye, 0), above);
  int paint = paint_of(hit.entry);
  float layer_m = paint >= paint_in_cuts ? 0.3 * (1.0 - v_dust) : 0.0;
  int level = level_of(from_eye, 0);
  float in_cleft = cleft_openness_at(from_eye, normal, level, above);
  Rock rock = rock_at((v_origin + hit.local) * voxel_m, local_normal, mix(abs(before), there, v_dust), layer_m,
                      paint < paint_in_cuts ? paint_colour(paint) : vec4(0.0), in_cleft, away);
  vec3 albedo = rock.albedo * (1.0 + 0.22 * (v_tint - 0.4) * (1.0 - v_dust));
  vec3 bent = normalize(rotated(v_rotation, rock.normal));
  float sunlight = max(dot(bent, u_sun), 0.0);
  if (level < u_levels && sunlight > 0.0) sunlight *= sun_at(from_eye + normal * (0.5 * voxel_m), u_sun, level);
  if (sunlight > 0.0) sunlight *= lit(hit.world, normal);
  o_colour = vec4(tone(in_fog(lit_rock(albedo, bent, openness_at(from_eye, normal, level, in_cleft) * rock.open, sunlight), hit.world, away)), 1.0);
}
