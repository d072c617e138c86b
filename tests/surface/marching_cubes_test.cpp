// Marching cubes of boxes: one closed surface, wherever one box ends, and where the field is zero.
#include "shared/surface/marching_cubes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/surface/surface_nets.h"
#include "tests/support/edge_uses.h"
#include "tests/support/mesh_position.h"
#include "tests/support/voxel_cube.h"

namespace scree {
namespace {

using Edges = EdgeUses<MeshPosition>;

void count(const SurfaceMesh& mesh, Edges& uses) {
  count_edges(
      std::span<const uint32_t>(mesh.indices), [&](uint32_t i) { return position_of(mesh, i); }, uses);
}

/// Every corner of ambiguity at once, with air all around.
Window noise(const VoxelBox& box, uint64_t random_seed) {
  Random random(random_seed);
  Window window(box);
  const VoxelBox inner = box.grown(-surface_nets_apron - 1);
  for (int x = inner.lo.x; x < inner.hi.x; ++x)
    for (int y = inner.lo.y; y < inner.hi.y; ++y)
      for (int z = inner.lo.z; z < inner.hi.z; ++z) {
        const int depth = static_cast<int>(random.below(128));
        window.at(x, y, z) = static_cast<Code>(random.below(8) < 1 + random_seed % 7 ? -depth : depth);
      }
  return window;
}

Window ball(const VoxelBox& box, float radius) {
  Window window(box);
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z)
        window.at(x, y, z) = encode(glm::length(glm::vec3(x, y, z)) - radius);
  return window;
}

TEST(MarchingCubes, every_edge_has_two_triangles_within_boxes_and_from_box_to_box) {
  for (uint64_t random_seed = 1; random_seed <= 7; ++random_seed) {
    const Window window = noise(cube(-20, 20), random_seed);
    Edges whole, parts;
    count(marching_cubes(window, cube(-16, 16)), whole);
    EXPECT_GT(whole.size(), 10000U);
    EXPECT_EQ(open_edges(whole), 0) << "random seed " << random_seed;
    // Sides that are no power of two, and rows of less than eight codes.
    for (int i = 0; i < 8; ++i) {
      const auto lo = [&](int bit) { return (i & bit) != 0 ? -11 : -16; };
      const auto hi = [&](int bit) { return (i & bit) != 0 ? 16 : -11; };
      count(marching_cubes(window, {{lo(4), lo(2), lo(1)}, {hi(4), hi(2), hi(1)}}), parts);
    }
    EXPECT_EQ(parts, whole) << "random seed " << random_seed;
  }
}

TEST(MarchingCubes, a_mask_leaves_out_exactly_what_it_says) {
  const Window window = noise(cube(-20, 20), 3);
  CellMask part(cube(-18, 17)), rest(cube(-18, 17));
  part.remove({{-3, -18, -5}, {9, 17, 2}});
  rest.remove({{-18, -18, -18}, {-3, 17, 17}});
  rest.remove({{9, -18, -18}, {17, 17, 17}});
  rest.remove({{-3, -18, -18}, {9, 17, -5}});
  rest.remove({{-3, -18, 2}, {9, 17, 17}});
  Edges whole, parts;
  count(marching_cubes(window, cube(-16, 16)), whole);
  for (const CellMask* mask : {&part, &rest}) {
    const SurfaceMesh mesh = marching_cubes(window, cube(-16, 16), nullptr, mask);
    EXPECT_FALSE(mesh.empty());
    count(mesh, parts);
  }
  EXPECT_EQ(parts, whole);
}

TEST(MarchingCubes, vertices_lie_on_the_surface_and_triangles_face_the_air) {
  constexpr float radius = 9.3F;
  const SurfaceMesh mesh = marching_cubes(ball(cube(-16, 16), radius), cube(-12, 12));
  const auto place = [&](uint32_t index) {
    const MeshPosition p = position_of(mesh, index);
    return glm::vec3(p[0], p[1], p[2]) / surface_steps_per_voxel;
  };
  for (uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_NEAR(glm::length(place(i)), radius, 0.04F);
    const auto& n = mesh.vertices[i].normal;
    EXPECT_GT(glm::dot(glm::normalize(glm::vec3(n[0], n[1], n[2])), glm::normalize(place(i))), 0.99F);
  }
  double volume = 0.0;
  for (size_t t = 0; t < mesh.indices.size(); t += 3)
    volume += static_cast<double>(glm::dot(place(mesh.indices[t]), glm::cross(place(mesh.indices[t + 1]),
                                                                              place(mesh.indices[t + 2])))) /
              6.0;
  EXPECT_NEAR(volume / (4.0 / 3.0 * 3.14159265 * radius * radius * radius), 1.0, 0.02);
}

TEST(MarchingCubes, air_and_rock_alone_have_no_surface) {
  for (const Code code : {code_air, code_solid, Code{0}})
    EXPECT_TRUE(marching_cubes(Window(cube(-6, 6), code), cube(-2, 2)).empty());
}

}  // namespace
}  // namespace scree
