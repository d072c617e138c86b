#include "shared/field/rough_noise.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Lattice points a side above which an octave counts as all of its amplitude: so many have values near it.
constexpr int points_a_side_max = 8;

/// More than rounding adds to a value between two corners, metres.
constexpr float rounding_m = 0.01F;

struct Points {
  int first[3];
  int last[3];

  bool many() const {
    return std::max({last[0] - first[0], last[1] - first[1], last[2] - first[2]}) >= points_a_side_max;
  }
};

/// The corners of the cells that the box touches. Rounding keeps the order of quotients, so that no place in
/// the box is counted to a cell beyond those of its ends.
Points points_of(glm::vec3 lo_m, glm::vec3 hi_m, float cell_m) {
  Points points{};
  for (int axis = 0; axis < 3; ++axis) {
    points.first[axis] = floor_to_int(lo_m[axis] / cell_m);
    points.last[axis] = floor_to_int(hi_m[axis] / cell_m) + 1;
  }
  return points;
}

}  // namespace

RoughRange rough_range(glm::vec3 lo_m, glm::vec3 hi_m, uint32_t random_seed) {
  CHECK(lo_m.x <= hi_m.x && lo_m.y <= hi_m.y && lo_m.z <= hi_m.z);
  RoughRange range{-rounding_m, rounding_m};
  for (uint32_t octave = 0; octave < octaves.size(); ++octave) {
    const Octave& each = octaves[octave];
    const Points points = points_of(lo_m, hi_m, each.cell_m);
    float least = points.many() ? -1.0F : 1.0F, most = -least;
    for (int x = points.first[0]; x <= points.last[0] && !points.many(); ++x)
      for (int y = points.first[1]; y <= points.last[1]; ++y)
        for (int z = points.first[2]; z <= points.last[2]; ++z) {
          const float value = lattice_value(static_cast<uint32_t>(x), static_cast<uint32_t>(y),
                                            static_cast<uint32_t>(z), octave_seed(random_seed, octave));
          least = std::min(least, value);
          most = std::max(most, value);
        }
    range.least_m += each.amplitude_m * least;
    range.most_m += each.amplitude_m * most;
  }
  return range;
}

}  // namespace scree
