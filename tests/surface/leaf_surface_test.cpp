#include "shared/surface/leaf_surface.h"

#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <utility>

#include "shared/base/random.h"
#include "shared/surface/marching_cubes.h"
#include "shared/surface/surface_nets.h"
#include "tests/support/edge_uses.h"

namespace scree {
namespace {

constexpr int extent = 24;
const VoxelBox region{{-extent / 2, -extent / 2, -extent / 2}, {extent / 2, extent / 2, extent / 2}};

template <typename F>
void for_each_cell(const VoxelBox& box, int step, F&& f) {
  for (int x = box.lo.x; x < box.hi.x; x += step)
    for (int y = box.lo.y; y < box.hi.y; y += step)
      for (int z = box.lo.z; z < box.hi.z; z += step) f(VoxelCoord{x, y, z});
}

void set_side(LeafGrid& grid, VoxelCoord at, int leaf, int side) {
  for_each_cell({at, at + VoxelCoord{leaf, leaf, leaf}}, 1,
                [&](VoxelCoord cell) { grid.side_at(cell) = static_cast<uint8_t>(side); });
}

/// Splits leaves that touch one of less than half their side, until there is none.
void balance(LeafGrid& grid) {
  bool changed = true;
  while (changed) {
    changed = false;
    for_each_cell(region, 1, [&](VoxelCoord cell) {
      const Leaf leaf = grid.leaf_at(cell);
      if (leaf.at != cell || leaf.side == 1) return;
      int smallest = leaf.side;
      const VoxelCoord size{leaf.side, leaf.side, leaf.side};
      for_each_cell(VoxelBox{leaf.at, leaf.at + size}.grown(1), 1, [&](VoxelCoord near) {
        const uint8_t side = std::as_const(grid).side_at(near);  // unknown beyond the region
        if (side != leaf_unknown) smallest = std::min<int>(smallest, side);
      });
      if (smallest * 2 >= leaf.side) return;
      set_side(grid, leaf.at, leaf.side, leaf.side / 2);
      changed = true;
    });
  }
}

LeafGrid random_octree(Random& random, const std::function<Code(VoxelCoord)>& code) {
  LeafGrid grid(region);
  std::ranges::fill(grid.distances, decode(code_air));
  for_each_cell(region, 4, [&](VoxelCoord at) {
    set_side(grid, at, 4, 4);
    if (random.below(2) == 0) return;
    for_each_cell({at, at + VoxelCoord{4, 4, 4}}, 2,
                  [&](VoxelCoord half) { set_side(grid, half, 2, random.below(3) == 0 ? 1 : 2); });
  });
  balance(grid);
  // Air all around closes the surface.
  for_each_cell(region.grown(-3), 1, [&](VoxelCoord p) { grid.distance_at(p) = decode(code(p)); });
  return grid;
}

std::vector<Leaf> all_leaves(const LeafGrid& grid) {
  std::vector<Leaf> leaves;
  for_each_cell(region, 1, [&](VoxelCoord cell) {
    if (grid.leaf_at(cell).at == cell) leaves.push_back(grid.leaf_at(cell));
  });
  return leaves;
}

struct Mean final : LeafRules {
  bool owns(std::span<const Leaf>) const override { return true; }
  glm::vec3 place(const Leaf&, std::span<const LeafCrossing> crossings) const override {
    return mean_of(crossings);
  }
};

int open_edges_of(const LeafMesh& mesh) {
  EdgeUses<uint32_t> uses;
  count_edges(
      std::span<const uint32_t>(mesh.indices), [](uint32_t index) { return index; }, uses);
  return open_edges(uses);
}

TEST(LeafSurface, every_edge_has_two_triangles_where_leaves_of_all_sizes_meet) {
  for (uint64_t random_seed = 1; random_seed <= 10; ++random_seed) {
    Random random(random_seed);
    const glm::vec3 centre(random.unit() * 2.0F, random.unit() * 2.0F, random.unit() * 2.0F);
    const LeafGrid grid = random_octree(random, [&](VoxelCoord p) {
      return encode((glm::length(glm::vec3(p.x, p.y, p.z) - centre) - 6.7F) * 0.3F);
    });
    const LeafMesh mesh = leaf_surface(grid, all_leaves(grid), Mean());
    EXPECT_GT(mesh.indices.size(), 300U);
    EXPECT_EQ(open_edges_of(mesh), 0) << "random seed " << random_seed;
  }
}

/// Every corner of ambiguity at once: no smooth field has as many.
LeafGrid noisy_octree(uint64_t random_seed) {
  Random random(random_seed);
  const uint32_t rock_in_8 = 1 + static_cast<uint32_t>(random_seed % 7);
  return random_octree(random, [&](VoxelCoord) {
    const int depth = 1 + static_cast<int>(random.below(126));
    return static_cast<Code>(random.below(8) < rock_in_8 ? -depth : depth);
  });
}

TEST(LeafSurface, every_edge_has_two_triangles_even_in_noise) {
  for (uint64_t random_seed = 1; random_seed <= 20; ++random_seed) {
    const LeafGrid grid = noisy_octree(random_seed);
    EXPECT_EQ(open_edges_of(leaf_surface(grid, all_leaves(grid), Mean())), 0)
        << "random seed " << random_seed;
  }
}

TEST(LeafCubes, every_edge_has_two_triangles_where_leaves_of_all_sizes_meet_even_in_noise) {
  for (uint64_t random_seed = 1; random_seed <= 20; ++random_seed) {
    const LeafGrid grid = noisy_octree(random_seed);
    const LeafMesh mesh = leaf_cubes(grid, all_leaves(grid));
    EXPECT_GT(mesh.indices.size(), 3000U);
    EXPECT_EQ(open_edges_of(mesh), 0) << "random seed " << random_seed;
  }
}

glm::vec3 place(const LeafMesh& mesh, size_t index) {
  const std::array<int32_t, 3>& steps = mesh.points[mesh.indices[index]].steps;
  return glm::vec3(steps[0], steps[1], steps[2]) / surface_steps_per_voxel;
}

TEST(LeafSurface, leaves_of_one_size_have_what_surface_nets_has) {
  Random random(5);
  Window noise(region.grown(surface_nets_apron), code_air);
  LeafGrid grid(region);
  std::ranges::fill(grid.sides, uint8_t{1});
  for_each_cell({region.lo, region.hi + VoxelCoord{1, 1, 1}}, 1, [&](VoxelCoord p) {
    Code& code = noise.at(p.x, p.y, p.z);
    const int depth = 1 + static_cast<int>(random.below(126));
    if (region.grown(-3).holds(p)) code = static_cast<Code>(random.below(4) == 0 ? -depth : depth);
    grid.distance_at(p) = code;
  });
  const LeafMesh ours = leaf_surface(grid, all_leaves(grid), Mean());
  const SurfaceMesh nets = surface_nets(noise, region);
  std::multiset<std::array<int32_t, 3>> here, there;
  for (const uint32_t index : ours.indices) here.insert(ours.points[index].steps);
  for (const uint32_t index : nets.indices) {
    const auto& p = nets.vertices[index].position;
    constexpr auto steps = surface_steps;
    there.insert({nets.origin.x * steps + p[0], nets.origin.y * steps + p[1], nets.origin.z * steps + p[2]});
  }
  EXPECT_GT(here.size(), 10000U);
  EXPECT_EQ(here.size(), there.size());
  EXPECT_EQ(std::set(here.begin(), here.end()), std::set(there.begin(), there.end()));
}

double volume_of(const LeafMesh& mesh) {
  double volume = 0.0;
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::vec3 a = place(mesh, t), b = place(mesh, t + 1), c = place(mesh, t + 2);
    volume += static_cast<double>(glm::dot(a, glm::cross(b, c))) / 6.0;
  }
  return volume;
}

TEST(LeafSurface, triangles_face_the_air) {
  Random random(3);
  const LeafGrid grid = random_octree(
      random, [](VoxelCoord p) { return encode((glm::length(glm::vec3(p.x, p.y, p.z)) - 6.3F) * 0.3F); });
  const LeafMesh mesh = leaf_surface(grid, all_leaves(grid), Mean());
  EXPECT_NEAR(volume_of(mesh) / (4.0 / 3.0 * 3.14159265 * 6.3 * 6.3 * 6.3), 1.0, 0.1);
}

TEST(LeafCubes, triangles_face_the_air) {
  Random random(3);
  const LeafGrid grid = random_octree(
      random, [](VoxelCoord p) { return encode((glm::length(glm::vec3(p.x, p.y, p.z)) - 6.3F) * 0.3F); });
  EXPECT_NEAR(volume_of(leaf_cubes(grid, all_leaves(grid))) / (4.0 / 3.0 * 3.14159265 * 6.3 * 6.3 * 6.3), 1.0,
              0.1);
}

}  // namespace
}  // namespace scree
