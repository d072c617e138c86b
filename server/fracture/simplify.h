// Chooses the points of a piece's surface that its body keeps: every point costs time in each contact (paper,
// 1.2.2: cut meshes are simplified by their convex hull or by merging vertices). Each way is a row of one
// table and a file of its own. The body is convex in each case. Deterministic; voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "shared/base/kind_table.h"

namespace scree {

/// The points that the body keeps of those of a surface; none if their hull is too thin to collide.
using ChoosePoints = std::vector<glm::vec3>(const std::vector<glm::vec3>& surface);

/// All points, up to whole_points_max (simplify_none.cpp).
ChoosePoints choose_all;
/// A few points whose convex hull is nearly that of all (hull_corners.h).
ChoosePoints choose_corners;
/// The means of points that are near each other (simplify_merge.cpp).
ChoosePoints choose_means;

enum class Simplifier : uint8_t { none = 0, hull = 1, merge = 2 };

struct SimplifierRow {
  std::string_view name;
  ChoosePoints* choose = nullptr;
};

constexpr SimplifierRow row_of(Simplifier simplifier) {
  switch (simplifier) {
    case Simplifier::none:
      return {.name = "none", .choose = choose_all};
    case Simplifier::hull:
      return {.name = "hull", .choose = choose_corners};
    case Simplifier::merge:
      return {.name = "merge", .choose = choose_means};
  }
  return {};
}

/// Most points that `none` and `merge` keep: the cost of a contact grows with them. Above: `none` keeps one
/// point of each cube of a grid, `merge` has a larger tolerance.
inline constexpr size_t whole_points_max = 128;
inline constexpr size_t merged_points_max = 48;

/// The means of clusters of points: a point joins the cluster whose first point is nearer than the tolerance.
/// That begins at a voxel and grows until at most `count_max` clusters, which is positive, are left.
std::vector<glm::vec3> merge_near(const std::vector<glm::vec3>& points, size_t count_max);

}  // namespace scree
