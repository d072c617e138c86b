// Sphere tracing through bricks.glsl.

const float lipschitz = 0.9;  // distances of edited, 8-bit fields overshoot by less than a tenth

struct Hit {
  bool found;
  float along;  // metres
  int level;
  Look there;
};

vec3 inverse_of(vec3 direction) {
  return 1.0 / mix(direction, vec3(1e-7), lessThan(abs(direction), vec3(1e-7)));
}

// Pixels that cover more of a voxel do not show whether an edge is rounded.
const float edge_pixel = 0.18;  // at 0.25 m a voxel, beyond some 25 m

// Whether planes of faces may say another distance there than the trilinear one, and a pixel of so many voxels shows it.
bool nears_edge(Look there, float pixel) {
#ifdef EDGES
  return there.kind == kind_stored && pixel < edge_pixel && nears_edge(there.entry, there.local, there.distance);
#else
  return false;
#endif
}

// From `from` (metres from the eye) along a unit direction, until the surface is within half a footprint of a
// pixel, which grows by `pixel` metres a metre, or to the `end`. Planes are asked in a loop of their own, for a processor
// that draws carries out both sides of a branch.
Hit march(vec3 from, vec3 direction, float along, float end, float pixel) {
  Hit hit;
  hit.found = false;
  hit.level = 0;
  vec3 inverse_direction = inverse_of(direction);
  int steps = 0;
  bool goes_on = true;
  while (goes_on) {
    bool edge = false;
    for (; steps < 256 && along < end; ++steps) {
      vec3 p = from + direction * along;
      hit.level = level_of(p, hit.level);
      if (hit.level >= u_levels) break;
      hit.there = look(p, hit.level);
      uint kind = hit.there.kind;
      if (kind == kind_unloaded) {
        ++hit.level;
        continue;
      }
      float per_m = u_voxels_per_m[hit.level];
      if (kind == kind_stored) {
        edge = nears_edge(hit.there, pixel * along * per_m);
        float close = max(0.02, 0.25 * pixel * along * per_m);
        hit.found = !edge && hit.there.distance < close;
        if (edge || hit.found) break;
        along += max(hit.there.distance * lipschitz, close) / per_m;
      } else {
        hit.found = kind == kind_solid;
        if (hit.found) break;
        along += way_out(hit.there, inverse_direction) / per_m;
      }
    }
    goes_on = edge;
#ifdef EDGES
    for (; edge && steps < 256 && along < end; ++steps) {
      float per_m = u_voxels_per_m[hit.level];
      float close = max(0.02, 0.25 * pixel * along * per_m);
      float distance = sharp_value(hit.there.entry, hit.there.local, hit.there.distance);
      hit.found = distance < close;
      if (hit.found) break;
      along += max(distance * lipschitz, close) / per_m;
      vec3 p = from + direction * along;
      if (level_of(p, hit.level) != hit.level) break;
      hit.there = look(p, hit.level);
      edge = nears_edge(hit.there, pixel * along * per_m);
    }
    goes_on = goes_on && !hit.found && steps < 256 && along < end;
#endif
  }
  hit.along = along;
  return hit;
}

// How far a cone is free that widens by `slope` metres a metre, about rays of `pixel` metres a metre; −1 if all the way.
float free_way(vec3 direction, float slope, float pixel) {
  float along = 0.0;
  int level = 0;
  for (int i = 0; i < 96; ++i) {
    vec3 p = direction * along;
    level = level_of(p, level);
    if (level >= u_levels) return -1.0;
    Look found = look(p, level);
    if (found.kind == kind_unloaded || found.kind == kind_solid) break;
    if (nears_edge(found, pixel * along * u_voxels_per_m[level])) break;
    float room = found.distance * lipschitz;
    if (found.kind != kind_stored) {
      vec3 nearest = min(-found.lo, found.hi);
      room = min(nearest.x, min(nearest.y, nearest.z));
    }
    float free = room / u_voxels_per_m[level] - along * slope;
    if (free * u_voxels_per_m[level] < 0.25) break;
    along += free / (1.0 + slope);
  }
  return along;
}

// The sun's light, 0 … 1, on a point off the surface. The sun is a disc: what it passes by closely dims it. Where the
// half shadow is wider than a coarser level's voxel, that level will do.
float sun_at(vec3 from, vec3 sun, int level) {
  const float sharpness = 38.0;  // 1 / tan of the disc's half angle, larger than the true sun's
  const float reach_m = 90.0;
  vec3 inverse_direction = inverse_of(sun);
  float light = 1.0;
  float along = 0.0;
  for (int i = 0; i < 96 && along < reach_m; ++i) {
    vec3 p = from + sun * along;
    if (level + 1 < u_levels && along * u_voxels_per_m[level] > 2.0 * sharpness) ++level;
    level = level_of(p, level);
    if (level >= u_levels) break;
    Look found = look(p, level);
    if (found.kind == kind_unloaded) {
      ++level;
      continue;
    }
    float per_m = u_voxels_per_m[level];
    if (found.kind == kind_solid) return 0.0;
    if (found.kind == kind_stored) {
      float away = found.distance / per_m;
      if (along > 0.0) light = min(light, 0.5 + 0.5 * sharpness * away / along);
      if (light <= 0.0) return 0.0;
      along += max(abs(found.distance) * lipschitz, 0.35) / per_m;
    } else {
      along += way_out(found, inverse_direction) / per_m;
    }
  }
  light = clamp(light, 0.0, 1.0);
  return light * light * (3.0 - 2.0 * light);
}

// 1 where the ground is even or juts out, less in a cleft, from the distance above the surface: over open ground it grows
// as fast as one climbs. At the height that meshes ask for, where something else may be as near as `other`.
float cleft_openness_at(vec3 from_eye, vec3 normal, int level, float other) {
  if (level >= u_levels) return 1.0;
  float found = field_at(from_eye + normal * (probe_height / u_voxels_per_m[level]), level);
  return clamp(min(found, other) / probe_height, 0.0, 1.0);
}

// 1 under the open sky, less in a crevice: that, and the same farther away, on coarser levels.
float openness_at(vec3 from_eye, vec3 normal, int level, float in_cleft) {
  float open = in_cleft;
  float weight = 0.6;
  for (int i = 1; i < 3 && level + i < u_levels; ++i) {
    float found = field_at(from_eye + normal * (probe_height / u_voxels_per_m[level + i]), level + i);
    open *= mix(1.0, clamp(found / probe_height, 0.0, 1.0), weight);
    weight *= 0.6;
  }
  return open;
}
