// Figures of Scree beside a peer: which side is better, and whether runs lie within the noise that is stated.
#include <algorithm>
#include <gtest/gtest.h>

#include "studies/peers/comparison.h"

namespace scree {
namespace {

Comparison cost(std::vector<double> ours, std::vector<double> theirs) {
  return {.name = "carve_ms",
          .what = "a carve, ms",
          .noise_percent = 10.0,
          .ours = std::move(ours),
          .theirs = std::move(theirs)};
}

bool within_noise(const Comparison& comparison) {
  PeerFindings findings{.peer = "Peer 1.0", .name = "peer", .conditions = {}};
  findings.figures = {comparison};
  BenchReport report;
  report_findings(findings, report);
  const auto found = std::ranges::find(report.checks, "peer_carve_ms_within_noise", &Check::name);
  EXPECT_NE(found, report.checks.end());
  return found != report.checks.end() && found->passed;
}

TEST(PeerComparison, less_is_better_unless_it_is_a_rate) {
  Comparison comparison = cost({2.0}, {8.0});
  EXPECT_EQ(comparison.ratio(), 4.0);
  comparison.more_is_better = true;
  EXPECT_EQ(comparison.ratio(), 0.25);
}

TEST(PeerComparison, a_machine_that_slows_both_down_adds_no_noise) {
  const Comparison both = cost({1.0, 2.0, 1.5}, {4.0, 8.0, 6.0});
  EXPECT_EQ(both.ratio(), 4.0);
  EXPECT_EQ(both.spread(), 0.0);
  EXPECT_TRUE(within_noise(both));
  EXPECT_FALSE(within_noise(cost({1.0, 2.0, 1.5}, {4.0, 4.0, 4.0})));
}

TEST(PeerComparison, the_ratio_is_the_median_of_the_runs_own) {
  const Comparison comparison = cost({1.0, 2.0, 1.0}, {1.0, 6.0, 5.0});
  EXPECT_EQ(comparison.ratios(), (std::vector<double>{1.0, 3.0, 5.0}));
  EXPECT_EQ(comparison.ratio(), 3.0);
}

TEST(PeerComparison, a_figure_of_one_side_has_that_sides_noise) {
  const Comparison theirs = cost({}, {10.0, 10.5, 10.2});
  EXPECT_EQ(theirs.ratio(), 0.0);
  EXPECT_TRUE(within_noise(theirs));
  EXPECT_FALSE(within_noise(cost({}, {10.0, 12.0, 10.2})));
  EXPECT_FALSE(within_noise(cost({10.0, 12.0, 10.2}, {})));
}

TEST(PeerComparison, what_took_nothing_has_no_ratio) {
  const Comparison comparison = cost({0.0, 0.0, 0.0}, {5.0, 5.0, 6.0});
  EXPECT_EQ(comparison.ratio(), 0.0);
  EXPECT_FALSE(within_noise(comparison));
}

}  // namespace
}  // namespace scree
