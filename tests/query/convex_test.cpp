// Convex bodies against what analysis says.
#include "shared/query/convex.h"

#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/query/query.h"
#include "shared/query/vectors.h"

namespace scree {
namespace {

constexpr double slack = 1.0 / 65536.0;

glm::dvec3 any_place(Random& random, double half) {
  return (glm::dvec3(random.unit(), random.unit(), random.unit()) - 0.5) * (2.0 * half);
}

glm::dvec3 any_way(Random& random) {
  for (;;) {
    const glm::dvec3 v = any_place(random, 1.0);
    if (glm::dot(v, v) > 0.01) return unit_of(v);
  }
}

struct Doubles {
  std::vector<glm::dvec3> points;
  double radius;

  explicit Doubles(const Convex& convex) : radius(static_cast<double>(convex.radius_m)) {
    for (const glm::vec3& point : convex.points_m) points.emplace_back(point);
  }
  Rounded rounded() const { return {points, radius}; }
};

double distance_to_box(glm::dvec3 p, glm::dvec3 half) {
  return glm::length(glm::max(glm::abs(p) - half, glm::dvec3(0.0)));
}

double distance_to_pill(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, double radius) {
  const double part = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::length(p - a - (b - a) * part) - radius;
}

TEST(Convex, distances_of_places_are_those_of_analysis) {
  Random random(1);
  uint32_t steps = 0;
  const glm::vec3 half(1.0F, 2.0F, 0.25F), a(-1.0F, 0.5F, 2.0F), b(2.0F, 0.0F, -1.0F);
  const Doubles box(convex_box({}, half)), pill(convex_capsule(a, b, 0.5F)), sphere(convex_sphere(a, 0.75F));
  const Doubles drum(convex_cylinder({}, 1.0F, 0.5F));
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 p = any_place(random, 3.0);
    const ConvexNear to_box = nearest_of_convex(p, box.rounded(), steps);
    EXPECT_NEAR(to_box.gap, distance_to_box(p, glm::dvec3(half)), 1e-9);
    EXPECT_EQ(to_box.meet, distance_to_box(p, glm::dvec3(half)) == 0.0);
    inside += to_box.meet ? 1 : 0;
    if (!to_box.meet) {
      EXPECT_LT(distance_to_box(to_box.on_second, glm::dvec3(half)), 1e-9);
      EXPECT_NEAR(glm::length(p - to_box.on_second), to_box.gap, 1e-9);
    }
    EXPECT_NEAR(nearest_of_convex(p, pill.rounded(), steps).gap,
                distance_to_pill(p, glm::dvec3(a), glm::dvec3(b), 0.5), 1e-9);
    EXPECT_NEAR(nearest_of_convex(p, sphere.rounded(), steps).gap, glm::length(p - glm::dvec3(a)) - 0.75,
                1e-9);
    // A drum of sixteen sides lies in that of the circle, and nearly fills it.
    const double beside = glm::max(glm::length(glm::dvec3(p.x, 0.0, p.z)) - 1.0, 0.0);
    const double above = glm::max(glm::abs(p.y) - 0.5, 0.0),
                 round = std::sqrt(beside * beside + above * above);
    const double to_drum = nearest_of_convex(p, drum.rounded(), steps).gap;
    EXPECT_GE(to_drum, round - 1e-6);
    EXPECT_LE(to_drum, round + 0.02);
  }
  EXPECT_GT(inside, 100);
}

TEST(Convex, distances_of_boxes_are_symmetric_and_part_them) {
  Random random(2);
  uint32_t steps = 0;
  int apart = 0;
  for (int i = 0; i < 5000; ++i) {
    std::vector<glm::dvec3> first, second;
    const glm::dvec3 off = any_place(random, 2.0);
    for (uint32_t k = 0; k < 4 + random.below(16); ++k) first.push_back(any_place(random, 1.0));
    for (uint32_t k = 0; k < 1 + random.below(12); ++k) second.push_back(any_place(random, 1.0) + off);
    const ConvexNear near = nearest_of_convex(Rounded{first, 0.0}, Rounded{second, 0.0}, steps);
    const ConvexNear back = nearest_of_convex(Rounded{second, 0.0}, Rounded{first, 0.0}, steps);
    EXPECT_EQ(near.meet, back.meet) << i;
    EXPECT_NEAR(near.gap, back.gap, 1e-9) << i;
    if (near.meet) continue;
    ++apart;
    // The slab between the two planes is empty: no other distance can be smaller.
    for (const glm::dvec3& p : first) EXPECT_GE(glm::dot(p - near.on_first, near.normal), -1e-8) << i;
    for (const glm::dvec3& p : second) EXPECT_LE(glm::dot(p - near.on_second, near.normal), 1e-8) << i;
    EXPECT_NEAR(glm::length(near.on_first - near.on_second), near.gap, 1e-9);
  }
  EXPECT_GT(apart, 1000);
}

std::optional<double> ray_to_sphere(glm::dvec3 from, glm::dvec3 unit, double radius) {
  const double towards = glm::dot(from, unit),
               root = towards * towards - glm::dot(from, from) + radius * radius;
  if (root < 0.0 || towards > 0.0) return std::nullopt;
  return -towards - std::sqrt(root);
}

std::optional<double> ray_to_box(glm::dvec3 from, glm::dvec3 unit, glm::dvec3 half) {
  double lo = -1e9, hi = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double a = (-half[i] - from[i]) / unit[i], b = (half[i] - from[i]) / unit[i];
    lo = std::max(lo, std::min(a, b));
    hi = std::min(hi, std::max(a, b));
  }
  return lo <= hi && lo >= 0.0 ? std::optional(lo) : std::nullopt;
}

TEST(Convex, casts_end_where_analysis_says) {
  Random random(3);
  uint32_t steps = 0;
  const glm::dvec3 half(1.0, 2.0, 0.25);
  const Doubles box(convex_box({}, glm::vec3(half))), sphere(convex_sphere({}, 0.75F));
  int hits = 0, grazing = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 from = any_place(random, 6.0), unit = any_way(random);
    const Rounded point{std::span(&from, 1), 0.0}, ball{std::span(&from, 1), 0.5};
    if (distance_to_box(from, half) > 0.01) {
      const auto hit = first_of_convex(point, unit, 20.0, box.rounded(), slack, steps);
      const auto truth = ray_to_box(from, unit, half);
      // Who passes within the slack may hit.
      if (truth || !hit) {
        ASSERT_EQ(hit.has_value(), truth.has_value()) << i;
        if (truth) {
          EXPECT_NEAR(hit->along, *truth, 1e-3) << i;
        }
      } else {
        ++grazing;
      }
      hits += truth ? 1 : 0;
    }
    if (glm::length(from) > 1.26) {
      const auto hit = first_of_convex(ball, unit, 20.0, sphere.rounded(), slack, steps);
      const auto truth = ray_to_sphere(from, unit, 1.25);
      if (!truth && hit) {
        ++grazing;
        continue;
      }
      ASSERT_EQ(hit.has_value(), truth.has_value()) << i;
      if (!truth) continue;
      EXPECT_NEAR(hit->along, *truth, 0.01) << i;
      EXPECT_NEAR(glm::length(hit->place), 0.75, 1e-9);
      EXPECT_NEAR(glm::dot(hit->normal, unit_of(hit->place)), 1.0, 1e-9);
    }
  }
  EXPECT_GT(hits, 400);
  EXPECT_LT(grazing, 10);
}

TEST(Convex, overlapping_ones_are_inside_and_touching_ones_may_part) {
  uint32_t steps = 0;
  const Doubles box(convex_box({}, glm::vec3(1.0F)));
  const glm::dvec3 in(0.5, 0.0, 0.0), above(0.0, 1.5, 0.0), up(0.0, 1.0, 0.0);
  const Rounded deep{std::span(&in, 1), 0.1}, resting{std::span(&above, 1), 0.5};
  EXPECT_TRUE(first_of_convex(deep, up, 5.0, box.rounded(), slack, steps)->inside);
  EXPECT_FALSE(first_of_convex(resting, up, 5.0, box.rounded(), slack, steps));
  EXPECT_FALSE(first_of_convex(resting, {1.0, 0.0, 0.0}, 5.0, box.rounded(), slack, steps));
  const auto down = first_of_convex(resting, -up, 5.0, box.rounded(), slack, steps);
  ASSERT_TRUE(down);
  EXPECT_FALSE(down->inside);
  EXPECT_EQ(down->along, 0.0);
}

TEST(Convex, odd_parts_are_refused) {
  EXPECT_TRUE(validate(convex_cylinder({}, 1.0F, 2.0F)));
  EXPECT_FALSE(validate(Convex{}));
  EXPECT_FALSE(validate(convex_sphere({}, -1.0F)));
  EXPECT_FALSE(validate(convex_sphere({}, std::numeric_limits<float>::quiet_NaN())));
  EXPECT_FALSE(validate(convex_box({1000.0F, 0.0F, 0.0F}, glm::vec3(1.0F))));
  EXPECT_FALSE(validate(convex_box({std::numeric_limits<float>::infinity(), 0.0F, 0.0F}, glm::vec3(1.0F))));
  EXPECT_FALSE(validate(Convex{std::vector<glm::vec3>(1000), 0.0F}));
}

}  // namespace
}  // namespace scree
