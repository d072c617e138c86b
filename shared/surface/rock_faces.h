// The flat faces of the rock about a cell, and where they meet. Pure, but for the memory of facets: not
// thread-safe. Units: voxels, from the cell's lowest corner.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/surface/facet.h"

namespace scree {

/// The facets of a window, each found when it is first asked for.
class FacetMap {
 public:
  /// The window must outlive it.
  explicit FacetMap(const Window& window) : window_(window), slots_(window.codes.size()) {}

  const Window& window() const { return window_; }
  /// The window holds the points around, too.
  const Facet& at(VoxelCoord point);

 private:
  const Window& window_;
  std::vector<int32_t> slots_;  ///< of the window's points: index in facets_ + 1; 0: not asked for yet
  std::deque<Facet> facets_;    ///< where they lie, they stay
};

/// The 4³ points about a cell, from one before it, z fastest.
inline constexpr size_t block_points = 64;

/// Their distances.
struct PointBlock {
  std::array<float, block_points> distance;
  std::array<int32_t, block_points> in_rock;  ///< 1 where they are known, not saturated, and in rock
  std::array<int32_t, block_points> in_air;   ///< or in air
  int rock = 0;
  int air = 0;

  PointBlock(const Window& window, VoxelCoord cell);
  /// Whether one plane explains them all.
  bool is_flat() const;
};

/// n · x = offset.
struct RockFace {
  glm::vec3 normal;
  float offset;
  int supporters;  ///< of all its facets
  std::array<float, block_points> distance;

  float distance_at(glm::vec3 x) const { return normal.x * x.x + normal.y * x.y + normal.z * x.z - offset; }
};

/// The faces that facets about the cell lie in: the five with the most supporters, those first.
std::vector<RockFace> rock_faces(FacetMap& facets, VoxelCoord cell);

/// The point of the cell nearest to `to` where the faces meet, one, two or three; none if that is elsewhere.
std::optional<glm::vec3> meeting_point(std::span<const RockFace* const> faces, glm::vec3 to);

/// Faces between which there is rock, or air. Where their distances are exact, in rock (the largest) or air
/// (the smallest): the share of the points there that they explain.
enum class Corner { convex, concave };
float explained_share(const PointBlock& block, std::span<const RockFace* const> faces, Corner corner);

}  // namespace scree
