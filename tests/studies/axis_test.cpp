#include "studies/scale/axis.h"

#include <cmath>
#include <gtest/gtest.h>

namespace scree {
namespace {

Axis made() {
  Axis axis{"carves", "Carves", "carves", "carves"};
  for (const double size : {1.0, 10.0, 100.0, 1000.0}) {
    for (const double noise : {0.9, 1.0, 1.3})
      axis.curve("memory", measure::size_mib).add(size, 2.0 * size * noise);
    axis.curve("idle tick", measure::time_ms).add(size, 0.5);
  }
  axis.curve("memory", measure::size_mib).limit(20000.0, "20 GB");
  axis.curve("idle tick", measure::time_ms).limit(16.6, "a tick");
  axis.curve("idle tick", measure::time_ms).flat(0.05);
  return axis;
}

TEST(Axis, a_point_is_the_median_or_the_least_of_its_rounds) {
  Curve median("a", "ms", Typical::median), least("b", "ms", Typical::least);
  for (const double value : {4.0, 2.0, 9.0}) {
    median.add(5.0, value);
    least.add(5.0, value);
  }
  EXPECT_EQ(median.points(), (std::vector<ScalePoint>{{5.0, 4.0}}));
  EXPECT_EQ(least.points(), (std::vector<ScalePoint>{{5.0, 2.0}}));
}

TEST(Axis, a_spread_is_half_of_what_the_rounds_lie_apart_and_a_least_has_none) {
  Curve median("a", "ms", Typical::median), least("b", "ms", Typical::least);
  for (const double value : {4.0, 2.0, 9.0, 5.0, 3.0}) {
    median.add(5.0, value);
    least.add(5.0, value);
  }
  EXPECT_EQ(median.spreads(), std::vector<double>{3.5});
  EXPECT_TRUE(least.spreads().empty());
}

TEST(Axis, the_law_of_the_end_is_that_of_the_dearest_three_sizes) {
  Curve curve("bricks", "MiB", Typical::median);
  for (const double size : {0.1, 0.2, 0.4}) curve.add(size, 1.0 / (size * size));
  for (const double size : {0.8, 1.6}) curve.add(size, 6.25);
  ASSERT_TRUE(curve.law_at_end());
  EXPECT_NEAR(curve.law_at_end()->exponent, -2.0, 1e-9);
}

TEST(Axis, walls_say_where_limits_are_met) {
  const auto walls = walls_of(made());
  ASSERT_EQ(walls.size(), 2U);
  ASSERT_TRUE(walls[0].crossing);
  EXPECT_NEAR(walls[0].crossing->size, 10000.0, 1e-6);
  EXPECT_FALSE(walls[0].crossing->measured);
  EXPECT_FALSE(walls[1].crossing) << "a flat curve never meets it";
}

TEST(Axis, a_section_has_a_plot_for_each_measure_and_a_row_for_each_size) {
  const ReportSection section = section_of(made());
  ASSERT_EQ(section.plots.size(), 2U);
  EXPECT_EQ(section.plots[0].name, "carves");
  EXPECT_EQ(section.plots[1].name, "carves-2");
  ASSERT_EQ(section.plots[0].series.size(), 2U);
  EXPECT_EQ(section.plots[0].series[1].name, "memory: exponent 1.000 ± 0.000");
  ASSERT_EQ(section.tables.size(), 2U);
  EXPECT_EQ(section.tables[1].rows.size(), 4U);
  EXPECT_EQ(section.tables[1].rows[3], (std::vector<std::string>{"1000", "2,000", "0.500"}));
}

TEST(Axis, figures_have_points_exponents_and_checks) {
  BenchReport figures;
  add_figures(made(), figures);
  ASSERT_EQ(figures.checks.size(), 1U);
  EXPECT_EQ(figures.checks[0].name, "carves_idle_tick_exponent");
  EXPECT_TRUE(figures.checks[0].passed);
  const auto has = [&](const char* name, double value) {
    for (const Metric& metric : figures.metrics)
      if (metric.name == name) return std::abs(metric.value - value) < 1e-9;
    return false;
  };
  EXPECT_TRUE(has("carves_memory_mib_at_1000", 2000.0));
  EXPECT_TRUE(has("carves_memory_exponent", 1.0));
}

TEST(Axis, a_curve_that_grows_fails_its_check) {
  Axis axis = made();
  axis.curve("memory", measure::size_mib).flat(0.05);
  BenchReport figures;
  add_figures(axis, figures);
  EXPECT_FALSE(figures.checks[0].passed);
}

TEST(Axis, names_of_metrics_are_plain) {
  EXPECT_EQ(metric_name("age of a frame, 99th percentile"), "age_of_a_frame_99th_percentile");
  EXPECT_EQ(metric_name("0.15"), "0_15");
}

}  // namespace
}  // namespace scree
