// Rows of places near a triangle: none that is near may be left out, and of a slender triangle most are.
#include "tools/import/mesh/triangle_distance.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "tools/import/mesh/mesh_solid.h"

namespace scree {
namespace {

class Dice {
 public:
  double from(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(bits_); }
  glm::dvec3 place(double reach) { return {from(-reach, reach), from(-reach, reach), from(-reach, reach)}; }

 private:
  std::mt19937_64 bits_{7};
};

bool holds(const NearRows& rows, const glm::dvec3& p) {
  const auto [first, last] = rows.at(p.x, p.y);
  return first <= p.z && p.z <= last;
}

TEST(NearRows, hold_each_place_that_is_near) {
  Dice dice;
  int near = 0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 a = dice.place(5.0), b = dice.place(5.0);
    // Every third is a sliver, and some lie in a plane of the axes or are points.
    glm::dvec3 c = i % 3 == 0 ? b + 0.01 * dice.place(1.0) : dice.place(5.0);
    if (i % 10 == 1) c.z = a.z;
    if (i % 20 == 0) c = a;
    const NearRows rows(a, b, c, 0.5);
    for (int k = 0; k < 500; ++k) {
      const double u = dice.from(0.0, 1.0), v = dice.from(0.0, 1.0 - u);
      const glm::dvec3 p = a + u * (b - a) + v * (c - a) + dice.place(0.6);
      if (distance_to(p, a, b, c) > 0.5) continue;
      ++near;
      EXPECT_TRUE(holds(rows, p)) << i;
    }
  }
  EXPECT_GT(near, 20'000);
}

TEST(NearRows, leave_out_most_of_the_box_around_a_sliver) {
  Dice dice;
  const glm::dvec3 a(0.0), b(10.0), c(10.0, 10.0, 9.9);
  const NearRows rows(a, b, c, 0.1);
  int held = 0;
  constexpr int all = 10'000;
  for (int i = 0; i < all; ++i) held += holds(rows, glm::dvec3(5.0) + dice.place(5.0)) ? 1 : 0;
  EXPECT_LT(held, all / 100);
}

/// Whatever is passed over for speed: near the surface each level is the distance to the nearest triangle.
TEST(MeshSolid, levels_near_the_surface_are_distances_to_its_triangles) {
  const std::vector<glm::dvec3> points = {{0.1, 0.2, 0.3}, {7.9, 1.1, 2.7}, {3.3, 6.9, 8.2}, {6.1, 7.7, 1.4}};
  TriangleMesh mesh{"tetrahedron", points, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  constexpr double voxel_m = 0.25;
  const auto solid = solid_of_mesh(mesh, {}, static_cast<float>(voxel_m));
  ASSERT_TRUE(solid) << solid.error().message;
  const VoxelBox box{{-3, -3, -3}, {36, 36, 36}};
  std::vector<float> levels(static_cast<size_t>(39) * 39 * 39);
  (*solid)->read_levels(box, levels);
  size_t i = 0, near = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z, ++i) {
        double least_m = 1e300;
        for (const auto& t : mesh.triangles)
          least_m = std::min(
              least_m, distance_to(glm::dvec3(x, y, z) * voxel_m, points[t[0]], points[t[1]], points[t[2]]));
        const double voxels = least_m / voxel_m;
        if (voxels < 0.01 || voxels > 1.99) continue;
        ++near;
        EXPECT_NEAR(std::abs(levels[i]), voxels, 1e-3) << x << " " << y << " " << z;
      }
  EXPECT_GT(near, 1000U);
}

}  // namespace
}  // namespace scree
