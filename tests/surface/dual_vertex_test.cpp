#include "shared/surface/dual_vertex.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "shared/surface/surface_mesh.h"

namespace scree {
namespace {

constexpr int half_extent = 20;
constexpr float half_side = 9.3F;

/// A cube, turned, in codes; or a hole of its shape.
Window cube_codes(const glm::quat& turn, bool hole) {
  const VoxelBox box{{-half_extent, -half_extent, -half_extent}, {half_extent, half_extent, half_extent}};
  Window window(box);
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) {
        const glm::vec3 q = glm::abs(glm::inverse(turn) * glm::vec3(x, y, z)) - half_side;
        const float outside = glm::length(glm::max(q, glm::vec3(0.0F)));
        const float distance = outside + std::min(std::max({q.x, q.y, q.z}), 0.0F);
        window.at(x, y, z) = encode(hole ? -distance : distance);
      }
  return window;
}

struct Rules final : LeafRules {
  mutable DualVertices vertices;
  bool sharp;

  Rules(const Window& codes, bool by_planes) : vertices(codes), sharp(by_planes) {}
  bool owns(std::span<const Leaf>) const override { return true; }
  glm::vec3 place(const Leaf& leaf, std::span<const LeafCrossing> crossings) const override {
    return sharp ? vertices.place(leaf.at, crossings) : mean_of(crossings);
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

/// The points of all leaves through which one of the cube's edges runs, not beside a corner: how far they are
/// from that edge. In order.
std::vector<float> edge_errors(const Window& window, bool sharp, const glm::quat& turn) {
  const LeafMesh mesh = mesh_of(window, sharp);
  std::map<VoxelCoord, glm::vec3> points;
  for (const LeafPoint& point : mesh.points)
    points[point.leaf.at] =
        glm::vec3(point.steps[0], point.steps[1], point.steps[2]) / surface_steps_per_voxel;
  constexpr float step = 0.01F;
  std::vector<float> errors;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 4; ++side) {
      std::set<VoxelCoord> inside;
      glm::vec3 p(0.0F);
      p[(axis + 1) % 3] = (side & 1) != 0 ? half_side : -half_side;
      p[(axis + 2) % 3] = (side & 2) != 0 ? half_side : -half_side;
      for (float along = 2.0F - half_side; along <= half_side - 2.0F; along += step) {
        p[axis] = along;
        const glm::vec3 at = glm::floor(turn * p);
        inside.insert({static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)});
      }
      for (const VoxelCoord& leaf : inside) {
        const auto found = points.find(leaf);
        if (found == points.end()) continue;
        glm::vec3 home = glm::inverse(turn) * found->second;
        p[axis] = home[axis];
        errors.push_back(glm::distance(home, p));
      }
    }
  std::ranges::sort(errors);
  return errors;
}

TEST(DualVertex, edges_of_turned_cubes_and_holes_are_kept_which_surface_nets_round_off) {
  for (int i = 0; i < 8; ++i) {
    const auto by = static_cast<float>(i);
    const glm::vec3 axis(0.31F + 0.21F * by, 0.83F - 0.15F * by, 0.46F);
    const glm::quat turn = glm::angleAxis(0.61F + 0.3F * by, glm::normalize(axis));
    const Window window = cube_codes(turn, i % 2 == 1);
    const std::vector<float> dual = edge_errors(window, true, turn);
    const std::vector<float> nets = edge_errors(window, false, turn);
    ASSERT_GT(dual.size(), 200U);
    // In the other cells all crossings are of one face: creases move their vertices (creases_test).
    EXPECT_LT(dual[dual.size() / 2], 0.06F) << "turn " << i;
    EXPECT_GT(nets[nets.size() / 5], 0.2F);
  }
}

constexpr float radius = 9.3F;

/// Where there is no edge, none is made.
TEST(DualVertex, a_ball_stays_round) {
  const VoxelBox box{{-half_extent, -half_extent, -half_extent}, {half_extent, half_extent, half_extent}};
  Window window(box);
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z)
        window.at(x, y, z) = encode(glm::length(glm::vec3(x, y, z)) - radius);
  const LeafMesh mesh = mesh_of(window, true);
  ASSERT_GT(mesh.points.size(), 1000U);
  float worst = 0.0F;
  for (const LeafPoint& point : mesh.points) {
    const glm::vec3 at = glm::vec3(point.steps[0], point.steps[1], point.steps[2]) / surface_steps_per_voxel;
    worst = std::max(worst, std::abs(glm::length(at) - radius));
  }
  EXPECT_LT(worst, 0.1F);
}

}  // namespace
}  // namespace scree
