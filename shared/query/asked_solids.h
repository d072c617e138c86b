// The solids that a question is about, near a box or a way.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "shared/query/limits.h"
#include "shared/query/query.h"

namespace scree {

inline bool is_asked(const QuerySolid& solid, const QueryMask& mask) {
  if (solid.volume != nullptr ? !mask.pieces : !mask.bodies || (solid.groups & mask.groups) == 0)
    return false;
  return std::find(mask.except.begin(), mask.except.end(), solid.id) == mask.except.end();
}

/// Calls each(index, solid) for those asked for whose boxes `is_near` is true of, in no order of ids.
template <typename IsNear, typename Each>
void for_each_asked(const QueryScene& scene, const QueryMask& mask, uint32_t& steps, IsNear&& is_near,
                    Each&& each) {
  if (!mask.pieces && !mask.bodies) return;
  const auto counted = [&](const SpaceBox& box) {
    ++steps;
    return is_near(box);
  };
  scene.tree().visit(counted, [&](size_t index) {
    const QuerySolid& solid = scene.solids()[index];
    if (is_asked(solid, mask)) each(index, solid);
  });
}

/// A part's points in doubles, for a while.
class PartPoints {
 public:
  explicit PartPoints(const Convex& part) : radius_(static_cast<double>(part.radius_m)) {
    CHECK(part.points_m.size() <= points_.size());
    for (const glm::vec3& point : part.points_m) points_[count_++] = glm::dvec3(point);
  }
  Rounded rounded() const { return {{points_.data(), count_}, radius_}; }

 private:
  std::array<glm::dvec3, limits::query_points_max> points_;
  size_t count_ = 0;
  double radius_;
};

/// A question's cost, once it is answered.
inline QueryCost cost_of(const QueryScene& scene, uint32_t steps) {
  return {steps, scene.terrain().chunks(), scene.terrain().exact()};
}

/// The material of a scene's terrain, or of a piece in its frame, under a place with that normal.
Material material_under(const QueryScene& scene, const glm::dvec3& place_m, const glm::dvec3& normal);
Material material_under(const Volume& volume, const glm::dvec3& place, const glm::dvec3& normal);

}  // namespace scree
