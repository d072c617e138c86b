// Which points of a piece's surface its body keeps: the more, the dearer (paper, 1.2.2: meshes that were cut
// want simplifying, by their convex hull or by merging vertices). Deterministic; voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace scree {

/// none: the whole surface's, as far as they are not too many. hull: a few whose convex hull is nearly that
/// of all (hull.h). merge: those nearer than a tolerance become one. Whichever: bodies are convex.
enum class Simplifier : uint8_t { none = 0, hull = 1, merge = 2 };

/// Most points that `none` and `merge` keep: cost per contact grows with them. Above: they are spread, or
/// merged, more widely.
inline constexpr size_t whole_points_max = 128;
inline constexpr size_t merged_points_max = 48;

/// Of the points that share a cube of a grid the first; at most `count_max`, in their order. Cubes have the
/// side given at least, and grow until they are few enough.
std::vector<glm::vec3> spread(const std::vector<glm::vec3>& points, float side_voxels, size_t count_max);

/// Points nearer than a voxel to one before become one with it, at their mean; at most `count_max`: the
/// tolerance grows until they are few enough.
std::vector<glm::vec3> merge_near(const std::vector<glm::vec3>& points, size_t count_max);

}  // namespace scree
