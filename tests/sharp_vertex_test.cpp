#include "shared/field/sharp_vertex.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <map>

#include "shared/field/surface_mesh.h"

namespace scree {
namespace {

constexpr int half_extent = 20;
constexpr float half_side = 9.3F;

/// A cube, turned, in codes.
Window cube_codes(const glm::quat& turn) {
  const VoxelBox box{{-half_extent, -half_extent, -half_extent}, {half_extent, half_extent, half_extent}};
  Window window(box);
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) {
        const glm::vec3 q = glm::abs(glm::inverse(turn) * glm::vec3(x, y, z)) - half_side;
        const float outside = glm::length(glm::max(q, glm::vec3(0.0F)));
        window.at(x, y, z) = encode(outside + std::min(std::max({q.x, q.y, q.z}), 0.0F));
      }
  return window;
}

struct Rules final : LeafRules {
  const Window& window;
  bool sharp;

  Rules(const Window& codes, bool by_planes) : window(codes), sharp(by_planes) {}
  bool owns(std::span<const Leaf>) const override { return true; }
  glm::vec3 place(const Leaf& leaf, std::span<const LeafCrossing> crossings) const override {
    return sharp ? sharp_vertex(window, leaf.at, crossings) : mean_of(crossings);
  }
};

LeafMesh mesh_of(const Window& window, bool sharp) {
  LeafGrid grid(window.box.grown(-3));
  std::ranges::fill(grid.sides, uint8_t{1});
  const VoxelBox& cells = grid.cells;
  std::vector<Leaf> leaves;
  for (int x = cells.lo.x; x <= cells.hi.x; ++x)
    for (int y = cells.lo.y; y <= cells.hi.y; ++y)
      for (int z = cells.lo.z; z <= cells.hi.z; ++z) {
        grid.distance_at({x, y, z}) = window.at(x, y, z);
        if (cells.holds({x, y, z})) leaves.push_back({{x, y, z}, 1});
      }
  return leaf_surface(grid, leaves, Rules(window, sharp));
}

/// Whether edges of the leaf are crossed by both faces, those across the two axes of the cube: a leaf that
/// one face alone crosses cannot know of the other.
bool sees_both_faces(const Window& window, const glm::quat& turn, VoxelCoord leaf, int u, int v) {
  bool sees_u = false;
  bool sees_v = false;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const VoxelCoord a{leaf.x + (i >> 2), leaf.y + ((i >> 1) & 1), leaf.z + (i & 1)};
      const VoxelCoord b{axis == 0 ? leaf.x + 1 : a.x, axis == 1 ? leaf.y + 1 : a.y,
                         axis == 2 ? leaf.z + 1 : a.z};
      const float at_a = decode(window.at(a.x, a.y, a.z)), at_b = decode(window.at(b.x, b.y, b.z));
      if (a == b || (at_a < 0.0F) == (at_b < 0.0F)) continue;
      const glm::vec3 p = glm::mix(glm::vec3(a.x, a.y, a.z), glm::vec3(b.x, b.y, b.z), at_a / (at_a - at_b));
      const glm::vec3 q = glm::abs(glm::inverse(turn) * p);
      (q[u] > q[v] ? sees_u : sees_v) = true;
    }
  return sees_u && sees_v;
}

/// The points of the leaves through which one of the cube's edges runs, not beside a corner, and that both of
/// its faces cross: how far they are from that edge. In order.
std::vector<float> edge_errors(const Window& window, bool sharp, const glm::quat& turn) {
  const LeafMesh mesh = mesh_of(window, sharp);
  std::map<VoxelCoord, glm::vec3> points;
  for (const LeafPoint& point : mesh.points)
    points[point.leaf.at] =
        glm::vec3(point.steps[0], point.steps[1], point.steps[2]) / surface_steps_per_voxel;
  constexpr float step = 0.02F;
  std::vector<float> errors;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 4; ++side) {
      std::map<VoxelCoord, int> inside;
      glm::vec3 p(0.0F);
      p[(axis + 1) % 3] = (side & 1) != 0 ? half_side : -half_side;
      p[(axis + 2) % 3] = (side & 2) != 0 ? half_side : -half_side;
      for (float along = 2.0F - half_side; along <= half_side - 2.0F; along += step) {
        p[axis] = along;
        const glm::vec3 at = glm::floor(turn * p);
        ++inside[{static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)}];
      }
      for (const auto& [leaf, count] : inside) {
        const auto found = points.find(leaf);
        if (found == points.end() || count < 10) continue;
        if (!sees_both_faces(window, turn, leaf, (axis + 1) % 3, (axis + 2) % 3)) continue;
        glm::vec3 home = glm::inverse(turn) * found->second;
        p[axis] = home[axis];
        errors.push_back(glm::distance(home, p));
      }
    }
  std::ranges::sort(errors);
  return errors;
}

TEST(SharpVertex, edges_of_turned_cubes_are_kept_which_surface_nets_round_off) {
  for (const glm::vec3 axis : {glm::vec3(0.31F, 0.83F, 0.46F), glm::vec3(0.9F, -0.2F, 0.38F)}) {
    const glm::quat turn = glm::angleAxis(0.61F, glm::normalize(axis));
    const Window window = cube_codes(turn);
    const std::vector<float> dual = edge_errors(window, true, turn);
    const std::vector<float> nets = edge_errors(window, false, turn);
    ASSERT_GT(dual.size(), 100U);
    // The rest are leaves of which one face has but a corner.
    EXPECT_LT(dual[dual.size() * 4 / 5], 0.05F);
    EXPECT_GT(nets[nets.size() / 5], 0.2F);
  }
}

}  // namespace
}  // namespace scree
