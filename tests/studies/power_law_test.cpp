#include "studies/scale/power_law.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "shared/base/random.h"

namespace scree {
namespace {

std::vector<ScalePoint> made(double factor, double exponent, const std::vector<double>& sizes) {
  std::vector<ScalePoint> points;
  for (const double size : sizes) points.push_back({size, factor * std::pow(size, exponent)});
  return points;
}

const std::vector<double> sizes = {1.0, 3.0, 10.0, 30.0, 100.0, 300.0};

TEST(PowerLaw, a_law_is_found_again_exactly) {
  for (const double exponent : {-3.0, 0.0, 0.5, 1.0, 2.0}) {
    const auto law = fit_power_law(made(0.7, exponent, sizes));
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, exponent, 1e-12);
    EXPECT_NEAR(law->factor, 0.7, 1e-12);
    EXPECT_NEAR(law->within, 0.0, 1e-6);
    EXPECT_NEAR(law->at(50.0), 0.7 * std::pow(50.0, exponent), 1e-9);
  }
}

/// About 95 in 100 fits to noisy points have the true exponent in their interval.
TEST(PowerLaw, the_interval_holds_the_exponent_as_often_as_it_says) {
  Random random(3);
  int held = 0;
  constexpr int fits = 4000;
  for (int i = 0; i < fits; ++i) {
    std::vector<ScalePoint> points = made(2.0, 0.8, sizes);
    for (ScalePoint& point : points) {
      double noise = -6.0;  // of twelve uniform ones: normal enough
      for (int j = 0; j < 12; ++j) noise += static_cast<double>(random.unit());
      point.value *= std::exp(0.2 * noise);
    }
    const auto law = fit_power_law(points);
    held += std::abs(law->exponent - 0.8) <= law->within ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(held) / fits, 0.95, 0.015);
}

TEST(PowerLaw, two_points_have_a_law_without_an_interval) {
  const auto law = fit_power_law(made(1.0, 1.5, {2.0, 8.0}));
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 1.5, 1e-12);
  EXPECT_TRUE(std::isinf(law->within));
}

TEST(PowerLaw, one_size_has_no_law_and_values_of_nothing_do_not_count) {
  EXPECT_FALSE(fit_power_law({}));
  EXPECT_FALSE(fit_power_law(std::vector<ScalePoint>{{5.0, 1.0}, {5.0, 2.0}}));
  EXPECT_FALSE(fit_power_law(std::vector<ScalePoint>{{5.0, 1.0}, {6.0, 0.0}}));
}

TEST(PowerLaw, students_t_is_that_of_the_tables) {
  EXPECT_NEAR(student_t(1), 12.706, 0.001);
  EXPECT_NEAR(student_t(10), 2.2281, 0.001);
  EXPECT_NEAR(student_t(11), 2.2010, 0.002);
  EXPECT_NEAR(student_t(30), 2.0423, 0.001);
  EXPECT_NEAR(student_t(1000000), 1.95997, 0.0001);
}

TEST(Crossing, lies_between_the_points_where_it_was_measured) {
  const auto found = crossing(made(1.0, 2.0, sizes), 400.0);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->measured);
  EXPECT_NEAR(found->size, 20.0, 1e-9);
}

TEST(Crossing, lies_beyond_the_last_point_by_the_law_of_the_end) {
  // A fixed cost of 10 hides the growth at small sizes: the end is linear.
  std::vector<ScalePoint> points;
  for (const double size : sizes) points.push_back({size, size < 25.0 ? 10.0 : size});
  const auto found = crossing(points, 3000.0);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->measured);
  EXPECT_NEAR(found->size, 3000.0, 1e-6);
}

TEST(Crossing, of_a_curve_that_falls_lies_at_smaller_sizes) {
  const auto measured = crossing(made(1.0, -3.0, {0.1, 0.2, 0.5, 1.0}), 64.0);
  ASSERT_TRUE(measured);
  EXPECT_TRUE(measured->measured);
  EXPECT_NEAR(measured->size, 0.25, 1e-9);
  const auto beyond = crossing(made(1.0, -3.0, {0.1, 0.2, 0.5, 1.0}), 8000.0);
  ASSERT_TRUE(beyond);
  EXPECT_FALSE(beyond->measured);
  EXPECT_NEAR(beyond->size, 0.05, 1e-9);
}

TEST(Crossing, is_the_first_point_where_that_is_over_the_limit_already) {
  const auto found = crossing(made(5.0, 1.0, sizes), 2.0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->size, 1.0);
}

TEST(Crossing, never_is_of_a_flat_curve) {
  EXPECT_FALSE(crossing(made(5.0, 0.02, sizes), 100.0));
}

TEST(Crossing, is_not_told_where_it_would_lie_far_beyond_what_was_measured) {
  EXPECT_TRUE(crossing(made(1.0, 1.0, sizes), 29000.0));
  EXPECT_FALSE(crossing(made(1.0, 1.0, sizes), 31000.0));
}

}  // namespace
}  // namespace scree
