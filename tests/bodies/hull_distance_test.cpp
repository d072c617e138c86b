// Distance between hulls, proven by its certificate: a plane between them, as wide as the points are apart.
#include "server/bodies/hull_distance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "shared/base/random.h"

namespace scree {
namespace {

using Kind = HullDistance::Kind;

glm::vec3 random_vec(Random& random) {
  return 2.0F * glm::vec3(random.unit(), random.unit(), random.unit()) - 1.0F;
}

std::vector<glm::vec3> random_corners(Random& random) {
  std::vector<glm::vec3> corners(4 + random.below(17));
  for (glm::vec3& corner : corners) corner = 0.5F * random_vec(random);
  return corners;
}

glm::mat3 random_turn(Random& random) {
  return glm::mat3_cast(
      glm::normalize(glm::quat(random.unit() + 0.1F, random.unit(), random.unit(), random.unit())));
}

/// Width of the gap between the hulls along the normal: never more than their distance.
float gap_along(const HullCorners& a, const HullCorners& b, glm::vec3 a_from_b, glm::vec3 normal) {
  const glm::vec3 low_a = a.corner(a.support(-normal)) + a_from_b;
  const glm::vec3 high_b = b.corner(b.support(normal));
  return glm::dot(low_a - high_b, normal);
}

TEST(HullDistance, of_a_thousand_moving_pairs_is_proven_by_a_plane_between_them) {
  Random random(5);
  int near = 0;
  for (int pair = 0; pair < 200; ++pair) {
    HullCorners a(random_corners(random)), b(random_corners(random));
    glm::vec3 a_from_b = 1.2F * random_vec(random);
    NearestCorners nearest;
    for (int tick = 0; tick < 10; ++tick) {
      a.turn(random_turn(random));
      a_from_b += 0.05F * random_vec(random);
      const HullDistance found = distance_between(a, b, a_from_b, 10.0F, nearest);
      ASSERT_NE(found.kind, Kind::apart);
      if (found.kind == Kind::overlapping) continue;
      ++near;
      EXPECT_NEAR(glm::dot(found.normal, found.normal), 1.0F, 1e-4F);
      EXPECT_NEAR(gap_along(a, b, a_from_b, found.normal), found.distance_m,
                  0.002F * found.distance_m + 1e-5F);
      const glm::vec3 on_a = found.on_b + found.normal * found.distance_m;
      EXPECT_GT(glm::dot(on_a - a_from_b, found.normal),
                glm::dot(a.corner(a.support(-found.normal)), found.normal) - 0.01F);
    }
  }
  EXPECT_GT(near, 500);
}

TEST(HullDistance, tells_overlap_from_contact) {
  const std::vector<glm::vec3> cube = {{-1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {-1, 1, 1},
                                       {1, -1, -1},  {1, -1, 1},  {1, 1, -1},  {1, 1, 1}};
  const HullCorners a(cube), b(cube);
  for (int step = 0; step < 400; ++step) {
    const float x = 0.005F + 0.01F * static_cast<float>(step);
    NearestCorners nearest;
    const HullDistance found = distance_between(a, b, {x, 0.3F, -0.2F}, 100.0F, nearest);
    EXPECT_EQ(found.kind, x < 2.0F ? Kind::overlapping : Kind::near) << "x = " << x;
    if (x > 2.0F) {
      EXPECT_NEAR(found.distance_m, x - 2.0F, 1e-4F);
    }
  }
}

TEST(HullDistance, beyond_the_reach_is_apart) {
  Random random(9);
  const HullCorners a(random_corners(random)), b(random_corners(random));
  NearestCorners nearest;
  for (int tick = 0; tick < 3; ++tick)
    EXPECT_EQ(distance_between(a, b, {3.0F, 0.0F, 0.0F}, 0.1F, nearest).kind, Kind::apart);
}

TEST(HullDistance, support_is_the_first_of_the_farthest) {
  const HullCorners corners({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}});
  EXPECT_EQ(corners.support({1.0F, 0.0F, 0.0F}), 1);
  EXPECT_EQ(corners.support({-1.0F, -1.0F, -1.0F}), 0);
  EXPECT_EQ(corners.support({0.0F, 0.0F, 2.0F}), 3);
}

}  // namespace
}  // namespace scree
