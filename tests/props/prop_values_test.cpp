// The geometry of props: hulls, masses, meshes.
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/prop/convex_hull.h"
#include "shared/prop/prop_solid.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

constexpr float pi = 3.14159265F;

double volume_of(const PropMesh& mesh) {
  double volume = 0.0;
  for (size_t i = 0; i < mesh.corners_m.size(); i += 3)
    volume += static_cast<double>(
        glm::dot(mesh.corners_m[i], glm::cross(mesh.corners_m[i + 1], mesh.corners_m[i + 2])) / 6.0F);
  return volume;
}

TEST(PropValues, a_cube_has_six_faces_of_four_corners_each) {
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1, (i >> 1) & 1, (i >> 2) & 1});
  corners.push_back({0.5F, 0.5F, 0.5F});
  corners.push_back({0.5F, 0.5F, 1.0F});  // in a face
  const std::vector<HullFace> faces = hull_faces(corners);
  ASSERT_EQ(faces.size(), 6U);
  for (const HullFace& face : faces) {
    EXPECT_EQ(face.corners.size(), 4U);
    const glm::vec3 a = corners[face.corners[0]], b = corners[face.corners[1]], c = corners[face.corners[2]];
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), face.normal), 0.9F);
  }
  EXPECT_LT(hull_faces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).size(), 4U);
}

TEST(PropValues, random_hulls_hold_all_their_points) {
  Random random(7);
  for (int round = 0; round < 20; ++round) {
    std::vector<glm::vec3> points;
    for (uint32_t i = 0; i < 4 + random.below(60); ++i)
      points.push_back({random.unit(), random.unit(), random.unit()});
    const std::vector<HullFace> faces = hull_faces(points);
    ASSERT_GE(faces.size(), 4U);
    for (const HullFace& face : faces)
      for (const glm::vec3& p : points)
        EXPECT_LT(glm::dot(p - points[face.corners.front()], face.normal), 1e-3F);
    Prop hull = prop_of({.kind = PropPartKind::hull, .corners_m = points}, 1.0F);
    EXPECT_NEAR(measure_of(hull).volume_m3, volume_of(mesh_of(hull.parts.front())), 1e-3);
  }
}

TEST(PropValues, masses_and_meshes_are_those_of_the_solids) {
  const auto measure = [](const PropPart& part) { return measure_of(prop_of(part, 1.0F)); };
  const PropPart ball{.kind = PropPartKind::sphere, .half_m = glm::vec3(0.5F)};
  EXPECT_NEAR(measure(ball).volume_m3, 4.0F / 3.0F * pi * 0.125F, 1e-4F);
  EXPECT_NEAR(measure(ball).inertia_m5[1][1], 0.4F * measure(ball).volume_m3 * 0.25F, 1e-4F);
  const PropPart tube{.kind = PropPartKind::cylinder, .half_m = {0.5F, 1.0F, 0.0F}};
  EXPECT_NEAR(measure(tube).volume_m3, pi * 0.25F * 2.0F, 1e-4F);
  const PropPart pill{.kind = PropPartKind::capsule, .half_m = {0.5F, 1.0F, 0.0F}};
  EXPECT_NEAR(measure(pill).volume_m3, measure(tube).volume_m3 + measure(ball).volume_m3, 1e-4F);
  const PropPart box{.kind = PropPartKind::box, .half_m = {0.5F, 1.0F, 0.25F}};
  EXPECT_NEAR(measure(box).volume_m3, 1.0F, 1e-5F);
  EXPECT_NEAR(measure(box).inertia_m5[0][0], (1.0F + 0.0625F) / 3.0F, 1e-4F);
  for (const PropPart& part : {ball, tube, pill, box})
    EXPECT_NEAR(volume_of(mesh_of(part)) / static_cast<double>(measure(part).volume_m3), 1.0, 0.03)
        << name_of(part.kind);
}

TEST(PropValues, a_compound_has_the_inertia_of_its_parts_about_their_common_middle) {
  Prop two = crate();
  two.parts = {{.kind = PropPartKind::box, .place_m = {-0.5F, 0, 0}, .half_m = glm::vec3(0.5F)},
               {.kind = PropPartKind::box, .place_m = {0.5F, 0, 0}, .half_m = glm::vec3(0.5F)}};
  const PropMeasure one =
                        measure_of(prop_of({.kind = PropPartKind::box, .half_m = {1.0F, 0.5F, 0.5F}}, 1.0F)),
                    both = measure_of(two);
  EXPECT_NEAR(both.volume_m3, one.volume_m3, 1e-5F);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(both.inertia_m5[i][i], one.inertia_m5[i][i], 1e-4F);
}

}  // namespace
}  // namespace scree
