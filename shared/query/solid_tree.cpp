#include "shared/query/solid_tree.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "shared/query/vectors.h"

namespace scree {

namespace {

/// Bits of a number below 2^16, each with two zeros before the next.
uint64_t spread(uint64_t x) {
  x = (x | (x << 16U)) & 0x0000FF0000FFULL;
  x = (x | (x << 8U)) & 0x00F00F00F00FULL;
  x = (x | (x << 4U)) & 0x0C30C30C30C3ULL;
  return (x | (x << 2U)) & 0x249249249249ULL;
}

/// The place on the curve of a box's middle, by cells of half a unit.
uint64_t place_on_curve(const SpaceBox& box) {
  const auto cell = [](double x) {
    return spread(static_cast<uint64_t>(std::clamp((x + 16384.0) * 2.0, 0.0, 65535.0)));
  };
  const glm::dvec3 middle = (box.lo + box.hi) * 0.5;
  return (cell(middle.x) << 2U) | (cell(middle.y) << 1U) | cell(middle.z);
}

}  // namespace

SpaceBox hull_of(const SpaceBox& a, const SpaceBox& b) {
  return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

bool passes(const SpaceBox& box, const glm::dvec3& from, const glm::dvec3& to) {
  double lo = 0.0, hi = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = to[axis] - from[axis];
    if (way == 0.0) {
      if (from[axis] < box.lo[axis] || from[axis] > box.hi[axis]) return false;
      continue;
    }
    const double a = (box.lo[axis] - from[axis]) / way, b = (box.hi[axis] - from[axis]) / way;
    lo = std::max(lo, std::min(a, b));
    hi = std::min(hi, std::max(a, b));
  }
  return lo <= hi;
}

SolidTree::SolidTree(std::vector<SpaceBox> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  std::vector<std::pair<uint64_t, uint32_t>> places;
  places.reserve(boxes_.size());
  for (uint32_t i = 0; i < boxes_.size(); ++i) places.emplace_back(place_on_curve(boxes_[i]), i);
  std::sort(places.begin(), places.end());
  std::vector<SpaceBox> below;
  for (const auto& [place, index] : places) {
    order_.push_back(index);
    below.push_back(boxes_[index]);
  }
  do {
    std::vector<SpaceBox> level;
    for (size_t i = 0; i < below.size(); i += fan) {
      SpaceBox hull = below[i];
      for (size_t k = i + 1; k < std::min(below.size(), i + fan); ++k) hull = hull_of(hull, below[k]);
      level.push_back(hull);
    }
    levels_.push_back(level);
    below = std::move(level);
  } while (below.size() > 1);
}

}  // namespace scree
