// Chooses the points of a piece's surface that its body keeps: every point costs time in each contact (paper,
// 1.2.2: cut meshes are simplified by their convex hull or by merging vertices). Deterministic; voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

namespace scree {

/// none: all points, up to a limit. hull: a few points whose convex hull is nearly that of all (hull.h).
/// merge: points nearer than a tolerance become one. The body is convex in each case.
enum class Simplifier : uint8_t { none = 0, hull = 1, merge = 2 };

struct SimplifierRow {
  std::string_view name;
};

constexpr SimplifierRow row_of(Simplifier simplifier) {
  switch (simplifier) {
    case Simplifier::none:
      return {.name = "none"};
    case Simplifier::hull:
      return {.name = "hull"};
    case Simplifier::merge:
      return {.name = "merge"};
  }
  return {};
}

/// Most points that `none` and `merge` keep: the cost of a contact grows with them. Above: `none` keeps one
/// point of each cube of a grid, `merge` has a larger tolerance.
inline constexpr size_t whole_points_max = 128;
inline constexpr size_t merged_points_max = 48;

/// The first point in each cube of a grid, in their order. The cubes' side begins at `side_voxels` and grows
/// until at most `count_max` points are left. Both are positive.
std::vector<glm::vec3> spread(const std::vector<glm::vec3>& points, float side_voxels, size_t count_max);

/// The means of clusters of points: a point joins the cluster whose first point is nearer than the tolerance.
/// That begins at a voxel and grows until at most `count_max` clusters, which is positive, are left.
std::vector<glm::vec3> merge_near(const std::vector<glm::vec3>& points, size_t count_max);

}  // namespace scree
