uniform usampler2D u_tiles;
uniform int u_tile;
uniform float u_pixel;  // metres a pixel covers at one metre
uniform mat4 u_view_projection;
uniform bool u_bodies;  // there are pieces or props, and the shadow map is theirs
in vec3 v_direction;
out vec4 o_colour;

void main() {
  vec3 direction = normalize(v_direction);
  float start = uintBitsToFloat(texelFetch(u_tiles, ivec2(gl_FragCoord.xy) / u_tile, 0).r);
  Hit hit;
  hit.found = false;
  if (start >= 0.0) hit = march(vec3(0.0), direction, start, u_pixel);
  if (!hit.found) {
    o_colour = vec4(tone(sky(direction)), 1.0);
    gl_FragDepth = 1.0;
    return;
  }
  vec3 from_eye = direction * hit.along;
  vec3 world = u_eye + from_eye;
  vec4 clip = u_view_projection * vec4(world, 1.0);
  gl_FragDepth = clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0);

  vec3 normal = -direction;
  vec2 worn = vec2(0.0);
  int material = 0;
  if (hit.there.kind == kind_stored) {
    normal = brick_normal(hit.there.entry, hit.there.local, normal);
#if SURFACES > 0
    float before = generated_in(hit.there.entry, hit.there.local, 0.0);
    if (before != 0.0) worn = worn_at(from_eye, normal, hit.level, before, band);
    material = look_at(hit.there.entry, hit.there.local, normal, before);
#endif
  }
  float in_cleft = cleft_openness_at(from_eye, normal, hit.level, band);
  float open = openness_at(from_eye, normal, hit.level, in_cleft);
  Rock rock = rock_at(world, normal, worn, material, in_cleft, hit.along);
  float sunlight = max(dot(rock.normal, u_sun), 0.0);
  float voxel = 1.0 / u_voxels_per_m[hit.level];
  if (sunlight > 0.0) sunlight *= sun_at(from_eye + normal * (0.5 * voxel), u_sun, hit.level);
  if (u_bodies && sunlight > 0.0) sunlight *= lit(world, normal);
  o_colour = vec4(tone(in_fog(lit_rock(rock, rock.normal, open * rock.open, sunlight, -direction), world, hit.along)), 1.0);
}
