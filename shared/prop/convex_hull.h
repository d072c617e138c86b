// The faces of a convex hull of a few points. Deterministic: + − × ÷ and sqrt alone. Metres.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace scree {

struct HullFace {
  std::vector<uint32_t> corners;  ///< numbers of the points, counterclockwise as seen from outside
  glm::vec3 normal{0.0F};         ///< unit, outward
};

/// By trying each plane through three points, which takes n³ steps, as most have points on both sides among
/// the first few that are looked at: for some dozens of points. Points within the hull are of no face. Fewer
/// than four faces: the points lie in a plane, or nearly.
std::vector<HullFace> hull_faces(const std::vector<glm::vec3>& points_m);

}  // namespace scree
