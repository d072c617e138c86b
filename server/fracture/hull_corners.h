// The simplifier `hull`: chooses the corners of a convex hull from the points of a shape's surface.
// Deterministic; voxels.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace scree {

/// Most corners of one hull: GJK's cost grows with them, and 20 already follow a cell
/// well.
inline constexpr int hull_corners_max = 20;

/// A few of the candidates whose hull is nearly that of all: each time the point farthest outside is added.
/// Empty when their hull is too thin to collide.
std::vector<glm::vec3> choose_corners(const std::vector<glm::vec3>& candidates);

/// The points if their hull is thick enough to collide; else none.
std::vector<glm::vec3> if_thick(std::vector<glm::vec3> points);

}  // namespace scree
