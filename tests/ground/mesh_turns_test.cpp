// Meshes whose neighbours cannot all agree: the file's own order stays, but for few triangles.
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "tools/import/mesh/mesh_parts.h"

namespace scree {
namespace {

constexpr uint32_t ball_rings = 12, ball_sides = 16;
constexpr double ball_radius_m = 6.0;

TriangleMesh ball() {
  TriangleMesh mesh;
  mesh.points.emplace_back(0.0, ball_radius_m, 0.0);
  for (uint32_t i = 1; i < ball_rings; ++i)
    for (uint32_t j = 0; j < ball_sides; ++j) {
      const double down = std::numbers::pi * i / ball_rings, around = 2.0 * std::numbers::pi * j / ball_sides;
      mesh.points.emplace_back(ball_radius_m * std::sin(down) * std::cos(around),
                               ball_radius_m * std::cos(down),
                               ball_radius_m * std::sin(down) * std::sin(around));
    }
  mesh.points.emplace_back(0.0, -ball_radius_m, 0.0);
  const auto last = static_cast<uint32_t>(mesh.points.size() - 1);
  const auto at = [](uint32_t i, uint32_t j) { return 1 + (i - 1) * ball_sides + j % ball_sides; };
  for (uint32_t j = 0; j < ball_sides; ++j) {
    mesh.triangles.push_back({0, at(1, j + 1), at(1, j)});
    mesh.triangles.push_back({last, at(ball_rings - 1, j), at(ball_rings - 1, j + 1)});
    for (uint32_t i = 1; i < ball_rings - 1; ++i) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  return mesh;
}

/// In place of a triangle, the projective plane of six points less a triangle: a small surface with one side.
void add_one_sided_patch(TriangleMesh& mesh, size_t place) {
  const TriangleMesh::Triangle t = mesh.triangles[place];
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(place));
  const auto first = static_cast<uint32_t>(mesh.points.size());
  const glm::dvec3 middle = (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0;
  for (const glm::dvec3& aside : {glm::dvec3(0.02, 0, 0), glm::dvec3(0, 0.02, 0), glm::dvec3(0, 0, 0.02)})
    mesh.points.push_back(middle + aside);
  const std::array<uint32_t, 6> corners{t[0], t[1], t[2], first, first + 1, first + 2};
  for (const auto& [a, b, c] : std::initializer_list<std::array<size_t, 3>>{
           {0, 1, 3}, {1, 2, 5}, {2, 0, 4}, {0, 3, 5}, {0, 4, 5}, {1, 3, 4}, {1, 4, 5}, {2, 3, 4}, {2, 3, 5}})
    mesh.triangles.push_back({corners[a], corners[b], corners[c]});
}

/// Which link is the first to contradict others depends on the order in the file.
void shuffle(std::vector<TriangleMesh::Triangle>& triangles, uint64_t seed) {
  for (size_t i = triangles.size() - 1; i > 0; --i) {
    seed = seed * 48271 % 2147483647;
    std::swap(triangles[i], triangles[seed % (i + 1)]);
  }
}

TEST(MeshTurns, a_patch_with_one_side_turns_no_wide_surface) {
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    TriangleMesh mesh = ball();
    const double ball_m3 = volume_m3(mesh);
    add_one_sided_patch(mesh, 8);
    shuffle(mesh.triangles, seed);
    weld(mesh, 0.0);
    PartFindings found;
    const std::vector<MeshPart> parts = parts_of(mesh, 0.0, found);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_LE(found.turned_triangles, 4U) << "of the patch alone, in order " << seed;
    EXPECT_LE(parts.front().open.size(), 6U) << seed;
    EXPECT_NEAR(parts.front().volume_m3, ball_m3, 0.01 * ball_m3) << seed;
  }
}

}  // namespace
}  // namespace scree
