#include "shared/surface/surface_nets.h"

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>
#include <utility>

#include "shared/base/random.h"
#include "tests/support/edge_uses.h"
#include "tests/support/mesh_position.h"
#include "tests/support/voxel_cube.h"

namespace scree {
namespace {

Window window_of(const VoxelBox& box, const std::function<float(glm::vec3)>& distance) {
  Window window(box);
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) window.at(x, y, z) = encode(distance(glm::vec3(x, y, z)));
  return window;
}

/// A vertex of a mesh made of several: its place in the world in 1/256 voxel, and which of a cell's sheets it
/// is on (two sheets may meet in a point without being joined).
struct Corner {
  MeshPosition position;
  std::array<int, 3> normal;

  auto operator<=>(const Corner&) const = default;
};

Corner corner(const SurfaceMesh& mesh, uint32_t index) {
  const auto& normal = mesh.vertices[index].normal;
  return {position_of(mesh, index), {normal[0], normal[1], normal[2]}};
}

using SheetEdges = EdgeUses<Corner>;

void count(const SurfaceMesh& mesh, SheetEdges& uses) {
  count_edges(
      std::span<const uint32_t>(mesh.indices), [&](uint32_t i) { return corner(mesh, i); }, uses);
}

/// Meshes blocks of `side` voxels that tile [0, extent)³ one by one, each from its own window.
SheetEdges mesh_in_blocks(const Window& whole, int extent, int side) {
  SheetEdges uses;
  for (int x = 0; x < extent; x += side)
    for (int y = 0; y < extent; y += side)
      for (int z = 0; z < extent; z += side) {
        const VoxelBox owned{{x, y, z}, {x + side, y + side, z + side}};
        count(surface_nets(part_of(whole, owned.grown(surface_nets_apron)), owned), uses);
      }
  return uses;
}

glm::vec3 place(const SurfaceMesh& mesh, const SurfaceVertex& v) {
  return glm::vec3(mesh.origin.x, mesh.origin.y, mesh.origin.z) +
         glm::vec3(v.position[0], v.position[1], v.position[2]) / surface_steps_per_voxel;
}

TEST(SurfaceNets, watertight_across_blocks_after_random_edits) {
  constexpr int extent = 48;
  Random random(7);
  Window whole = window_of(cube(-surface_nets_apron, extent + surface_nets_apron),
                           [](glm::vec3 p) { return glm::length(p - glm::vec3(24.0F)) - 17.3F; });
  for (int edit = 0; edit < 60; ++edit) {
    const glm::vec3 centre = glm::vec3(random.unit(), random.unit(), random.unit()) * 36.0F + 6.0F;
    const float radius = 1.5F + random.unit() * 4.0F;
    const bool carving = random.below(3) != 0;
    const VoxelBox& box = whole.box;
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y)
        for (int z = box.lo.z; z < box.hi.z; ++z) {
          const float d = glm::length(glm::vec3(x, y, z) - centre) - radius;
          Code& code = whole.at(x, y, z);
          code = carving ? std::max(code, encode(-d)) : std::min(code, encode(d));
        }
    if (edit % 12 != 11) continue;
    const SheetEdges uses = mesh_in_blocks(whole, extent, 16);
    EXPECT_GT(uses.size(), 1000U);
    EXPECT_EQ(open_edges(uses), 0) << "after edit " << edit;
  }
}

/// Every corner of ambiguity at once: no smooth field has as many. Sheets of one cell that come out at the
/// same place are told apart by their index, so within one mesh edges are counted by index.
TEST(SurfaceNets, every_edge_has_two_triangles_even_in_noise) {
  for (uint64_t random_seed = 1; random_seed <= 40; ++random_seed) {
    Random random(random_seed);
    Window noise(cube(0, 20));
    const uint32_t rock_in_8 = 1 + static_cast<uint32_t>(random_seed % 7);
    for (Code& code : noise.codes) {
      const int depth = 1 + static_cast<int>(random.below(126));
      code = static_cast<Code>(random.below(8) < rock_in_8 ? -depth : depth);
    }
    const SurfaceMesh mesh = surface_nets_closed(noise);
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (size_t t = 0; t < mesh.indices.size(); t += 3)
      for (size_t i = 0; i < 3; ++i) ++uses[{mesh.indices[t + i], mesh.indices[t + (i + 1) % 3]}];
    int open = 0;
    for (const auto& [edge, count] : uses) {
      const auto back = uses.find({edge.second, edge.first});
      if (count != 1 || back == uses.end() || back->second != 1) ++open;
    }
    EXPECT_EQ(open, 0) << "random seed " << random_seed;
  }
}

TEST(SurfaceNets, sphere_has_its_area_and_normals) {
  constexpr float radius = 12.4F;
  const SurfaceMesh mesh =
      surface_nets_closed(window_of(cube(-16, 16), [](glm::vec3 p) { return glm::length(p) - radius; }));
  double area = 0.0;
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::vec3 a = place(mesh, mesh.vertices[mesh.indices[t]]);
    const glm::vec3 b = place(mesh, mesh.vertices[mesh.indices[t + 1]]);
    const glm::vec3 c = place(mesh, mesh.vertices[mesh.indices[t + 2]]);
    const glm::vec3 normal = glm::cross(b - a, c - a);
    area += 0.5 * static_cast<double>(glm::length(normal));
    EXPECT_GT(glm::dot(normal, a + b + c), 0.0F) << "a triangle faces inward";
  }
  const double exact = 4.0 * 3.14159265 * radius * radius;
  EXPECT_NEAR(area / exact, 1.0, 0.01);
  float worst = 1.0F;
  float farthest = 0.0F;
  for (const SurfaceVertex& v : mesh.vertices) {
    const glm::vec3 p = place(mesh, v);
    const glm::vec3 normal = glm::normalize(glm::vec3(v.normal[0], v.normal[1], v.normal[2]));
    worst = std::min(worst, glm::dot(normal, glm::normalize(p)));
    farthest = std::max(farthest, std::abs(glm::length(p) - radius));
  }
  EXPECT_GT(worst, std::cos(2.5F * 3.14159265F / 180.0F));
  EXPECT_LT(farthest, 0.06F);
}

TEST(SurfaceNets, window_without_surface_gives_no_triangles) {
  for (const Code code : {code_air, code_solid, Code{-1}, Code{0}, Code{1}}) {
    const Window window(cube(0, 16).grown(surface_nets_apron), code);
    EXPECT_TRUE(surface_nets(window, cube(0, 16)).empty());
  }
  EXPECT_TRUE(surface_nets_closed(Window{}).empty());
}

TEST(SurfaceNets, long_windows_are_meshed_as_short_ones) {
  const VoxelBox owned{{0, 0, 0}, {16, 16, 200}};
  const Window window = window_of(owned.grown(surface_nets_apron), [](glm::vec3 p) {
    return 5.0F - glm::length(glm::vec3(p.x - 8.0F, p.y - 8.0F, std::fmod(p.z + 5.0F, 25.0F) - 12.0F));
  });
  SheetEdges whole;
  count(surface_nets(window, owned), whole);
  SheetEdges parts;
  for (int z = 0; z < 200; z += 25) {
    const VoxelBox part{{0, 0, z}, {16, 16, z + 25}};
    count(surface_nets(part_of(window, part.grown(surface_nets_apron)), part), parts);
  }
  EXPECT_GT(whole.size(), 1000U);
  EXPECT_EQ(whole, parts);
}

TEST(SurfaceNets, vertices_carry_what_was_there_before) {
  const VoxelBox owned = cube(0, 16);
  const VoxelBox box = owned.grown(surface_nets_apron);
  const Window before = window_of(box, [](glm::vec3 p) { return p.y - 10.0F; });
  const Window after = window_of(box, [](glm::vec3 p) {
    return std::max(p.y - 10.0F, 5.0F - glm::length(p - glm::vec3(8.0F, 10.0F, 8.0F)));
  });
  int fresh = 0;
  for (const SurfaceVertex& v : surface_nets(after, owned, &before).vertices) {
    const float depth = static_cast<float>(v.position[1]) / surface_steps_per_voxel - 1.0F - 10.0F;
    EXPECT_NEAR(decode(v.before), std::max(depth, -band_voxels), 0.1F);
    if (v.before < -40) ++fresh;
  }
  EXPECT_GT(fresh, 30);
}

TEST(SurfaceNets, crevices_are_less_open_than_plains) {
  const VoxelBox owned = cube(0, 16);
  const SurfaceMesh mesh = surface_nets(window_of(owned.grown(surface_nets_apron),
                                                  [](glm::vec3 p) {
                                                    const float side = std::abs(p.x - 8.0F);
                                                    return (p.y - 8.0F - side) * 0.7071F;
                                                  }),
                                        owned);
  for (const SurfaceVertex& v : mesh.vertices) {
    const float side = std::abs(static_cast<float>(v.position[0]) / surface_steps_per_voxel - 1.0F - 8.0F);
    if (side < 0.5F) {
      EXPECT_LT(v.openness, 215);
    }
    if (side > 4.0F) {
      EXPECT_GT(v.openness, 245);
    }
  }
}

}  // namespace
}  // namespace scree
