// The report of the paper's experiments says what was measured: verdicts follow the figures.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "studies/paper/findings/analysis.h"
#include "studies/paper/findings/composition.h"

namespace scree::paper {
namespace {

constexpr double rate_hz = 60.0;

SettingFound setting(double size, double draw_ms, double memory_mib = 100.0) {
  return {.size = size,
          .draw_ms = {draw_ms, draw_ms * 1.02},
          .update_ms = {1.0, 1.01},
          .heap_mib = 0.5 * memory_mib,
          .gpu_mib = 0.5 * memory_mib,
          .triangles = 10.0,
          .reach_m = size / 8.0,
          .frames = 6,
          .state_hash = 7};
}

/// One tick each sixtieth of a second, a frame after each.
template <typename Make>
SessionFound session(const std::string& name, double seconds, Make make) {
  SessionFound found{name, {}};
  for (int i = 0; i < static_cast<int>(seconds * rate_hz); ++i) {
    SessionTick tick{.time_s = i / rate_hz, .update_ms = 1.0, .bodies_ms = 0.5, .draw_ms = 10.0};
    make(i, tick);
    found.ticks.push_back(tick);
  }
  return found;
}

SessionFound rebuild_session(const std::string& name, double bodies_spike_ms, double draw_spike_ms) {
  return session(name, 6.0, [&](int i, SessionTick& tick) {
    tick.pieces = 100;
    tick.reshaped = tick.edited = i % 15 == 7 && tick.time_s >= 3.0;
    if (!tick.reshaped) return;
    tick.bodies_ms = bodies_spike_ms;
    tick.draw_ms = draw_spike_ms;
  });
}

SessionFound carving_session(double carved_ms) {
  return session("s", 12.0, [&](int i, SessionTick& tick) {
    tick.edited = tick.time_s >= 2.0 && tick.time_s < 4.0 && i % 15 == 0;
    tick.switched = i == 8 * 60 || i == 10 * 60;
    const bool grid = tick.time_s >= 8.0 && tick.time_s < 10.0;
    tick.draw_ms = grid ? 20.0 : tick.time_s < 2.0 ? 10.0 : carved_ms;
  });
}

/// As the paper and Scree are expected to be.
Findings expected() {
  Findings found;
  found.conditions = {.driver = "OpenGL 4.5 (a driver)",
                      .full_width = 1280,
                      .full_height = 720,
                      .session_width = 384,
                      .session_height = 216,
                      .setting_s = 10.0,
                      .rounds = 2};
  found.grids = {{"uniform spacing", {setting(32, 10.0), setting(64, 40.0), setting(128, 160.0)}},
                 {"growing spacing", {setting(32, 12.0), setting(64, 50.0), setting(128, 200.0)}}};
  found.raymarch = {"raymarch", {setting(50, 20.0), setting(100, 80.0)}};
  found.carving = {.atlas = carving_session(10.2),
                   .list = carving_session(40.0),
                   .fresh_until_s = 2.0,
                   .switched_at_s = 8.0,
                   .returned_at_s = 10.0,
                   .settle_s = 0.2,
                   .carves = 8,
                   .atlas_lived_ms = 10.1,
                   .atlas_new_ms = 10.0,
                   .grid_fresh_ms = 20.0,
                   .grid = "64 cells"};
  found.rebuild = {.colliders = {rebuild_session("mesh", 2.0, 10.1), rebuild_session("rays", 0.52, 10.0),
                                 rebuild_session("field", 0.55, 10.0)},
                   .pieces = 100,
                   .carving_from_s = 3.0,
                   .runs = 3};
  const auto blast = [&](bool merges) {
    return session("", 10.0, [&](int i, SessionTick& tick) {
      tick.edited = i == 120;
      const bool busy = tick.time_s > 2.0 && (!merges || tick.time_s < 7.0);
      tick.pieces = busy ? 300 : 0;
      tick.merged = merges && i == 400;
      tick.update_ms = busy ? 5.0 : 0.02;
      tick.draw_ms = busy ? 15.0 : 10.0;
    });
  };
  found.merging = {.merging = blast(true), .staying = blast(false), .blast_from_s = 2.0};
  return found;
}

bool passed(const StudyResult& result, const std::string& name) {
  const auto& checks = result.figures.checks;
  const auto found = std::ranges::find(checks, name, &Check::name);
  EXPECT_NE(found, checks.end()) << name;
  return found != checks.end() && found->passed;
}

/// How often a verdict stands in the table of claims.
size_t verdicts(const StudyResult& result, const std::string& verdict) {
  size_t count = 0;
  for (const auto& row : result.report.sections.front().tables.front().rows)
    if (row.back() == "**" + verdict + "**") ++count;
  return count;
}

std::string verdict_about(const StudyResult& result, const std::string& words) {
  for (const auto& row : result.report.sections.front().tables.front().rows)
    if (row[0].find(words) != std::string::npos || row[2].find(words) != std::string::npos) return row.back();
  return "none";
}

const ReportSection& section_of(const StudyResult& result, const std::string& title) {
  const auto& sections = result.report.sections;
  const auto found = std::ranges::find_if(
      sections, [&](const ReportSection& section) { return section.title.starts_with(title); });
  EXPECT_NE(found, sections.end()) << title;
  return found == sections.end() ? sections.front() : *found;
}

/// The paragraph of a figure that explains it.
std::string why(const StudyResult& result, const std::string& title) {
  return section_of(result, title).text.back();
}

TEST(PaperFindings, what_is_expected_passes_every_check) {
  const StudyResult result = compose(expected());
  for (const Check& check : result.figures.checks)
    EXPECT_TRUE(check.passed) << check.name << ": " << check.detail;
  EXPECT_GT(result.figures.checks.size(), 6U);
  EXPECT_EQ(verdicts(result, "undecided"), 0U);
}

TEST(PaperFindings, every_figure_of_the_paper_has_its_counterpart_with_points) {
  const StudyResult result = compose(expected());
  std::vector<std::string> names;
  for (const ReportSection& section : result.report.sections)
    for (const Plot& plot : section.plots) {
      names.push_back(plot.name);
      for (const PlotSeries& series : plot.series)
        EXPECT_FALSE(series.points.empty()) << plot.name << series.name;
    }
  for (const int number : {16, 17, 18, 21, 22, 23, 24, 25, 26, 27, 28})
    EXPECT_EQ(std::ranges::count(names, "figure-" + std::to_string(number)), 1) << number;
}

TEST(PaperFindings, a_grid_that_is_faster_refutes_the_claim) {
  Findings found = expected();
  found.raymarch.settings.back() = setting(100, 400.0);
  const StudyResult result = compose(found);
  EXPECT_FALSE(passed(result, "raymarch_beats_grid"));
  EXPECT_EQ(verdict_about(result, "On fresh terrain"), "**refuted**");
  EXPECT_EQ(verdict_about(result, "most efficient"), "**refuted**");
}

TEST(PaperFindings, an_atlas_that_degrades_is_told) {
  Findings found = expected();
  found.carving.atlas = carving_session(16.0);
  const StudyResult result = compose(found);
  EXPECT_FALSE(passed(result, "atlas_flat"));
  EXPECT_EQ(verdict_about(result, "Scree's atlas"), "**confirmed**");
  found.carving.atlas = carving_session(12.0);
  EXPECT_EQ(verdict_about(compose(found), "Scree's atlas"), "**undecided**");
}

TEST(PaperFindings, an_atlas_that_is_slower_than_a_new_one_is_told) {
  Findings found = expected();
  found.carving.atlas_lived_ms = 12.0;
  EXPECT_FALSE(passed(compose(found), "atlas_as_new"));
}

TEST(PaperFindings, an_update_that_gets_shorter_does_not_confirm_that_it_grows) {
  Findings found = expected();
  found.raymarch.settings.front().update_ms = {3.0, 3.1};
  EXPECT_EQ(verdict_about(compose(found), "raymarched resolution"), "**refuted**");
  found.raymarch.settings.back().update_ms = {6.0, 6.1};
  EXPECT_EQ(verdict_about(compose(found), "raymarched resolution"), "**confirmed**");
}

TEST(PaperFindings, spikes_are_told_by_collider) {
  Findings found = expected();
  found.rebuild.colliders.back() = rebuild_session("field", 1.5, 10.0);
  EXPECT_FALSE(passed(compose(found), "field_has_no_spikes"));
  found = expected();
  found.rebuild.colliders.front() = rebuild_session("mesh", 0.5, 30.0);
  const StudyResult result = compose(found);
  EXPECT_FALSE(passed(result, "mesh_has_spikes"));
  EXPECT_EQ(verdict_about(result, "drawing has a spike"), "**confirmed**");
}

TEST(PaperFindings, a_world_that_stays_slow_after_merging_refutes_the_return) {
  Findings found = expected();
  found.merging.merging = found.merging.staying;
  EXPECT_FALSE(passed(compose(found), "returns_after_merging"));
}

TEST(PaperFindings, settings_that_did_other_work_are_not_compared) {
  Findings found = expected();
  found.grids[0].settings[1].state_hash = 8;
  EXPECT_FALSE(passed(compose(found), "grid_update_grows_same_work"));
}

TEST(PaperFindings, a_quick_run_says_so_and_is_not_called_full) {
  Findings found = expected();
  EXPECT_EQ(compose(found).report.command, "./scree bench paper");
  EXPECT_NE(verdict_about(compose(found), "faster than the grid."), "none");
  found.conditions.quick = true;
  found.raymarch.settings = {setting(25, 20.0), setting(50, 80.0)};
  const StudyResult quick = compose(found);
  EXPECT_EQ(quick.report.command, "./scree bench paper --quick");
  EXPECT_NE(verdict_about(quick, "here at 50 % of it"), "none");
  EXPECT_EQ(std::ranges::count(quick.figures.metrics, std::string("grid_over_raymarch_full"), &Metric::name),
            0);
}

TEST(PaperFindings, explanations_follow_the_verdict) {
  const StudyResult usual = compose(expected());
  Findings found = expected();
  found.rebuild.colliders = {rebuild_session("mesh", 0.5, 30.0), rebuild_session("rays", 0.5, 10.0),
                             rebuild_session("field", 2.0, 10.0)};
  found.merging.merging = found.merging.staying;
  const StudyResult other = compose(found);
  for (const char* title : {"Figure 26", "Figure 27", "Figure 28"})
    EXPECT_NE(why(usual, title), why(other, title)) << title;
}

TEST(PaperFindings, least_times_of_several_runs_are_called_that) {
  for (const bool several : {true, false}) {
    Findings found = expected();
    found.rebuild.runs = several ? 3 : 1;
    const StudyResult result = compose(found);
    const std::string said = several ? "least of 3 runs" : "one run";
    const ReportSection& section = section_of(result, "Figure 26");
    EXPECT_NE(section.plots.front().y_label.find(said), std::string::npos);
    EXPECT_NE(section.tables.front().header[1].find(said), std::string::npos);
    EXPECT_NE(section_of(result, "Figure 27").plots.front().y_label.find(said), std::string::npos);
  }
}

TEST(PaperFindings, a_list_that_draws_another_terrain_is_not_compared_in_milliseconds) {
  const StudyResult result = compose(expected());
  for (const char* title : {"Conditions", "Figure 24", "Figure 25"}) {
    const auto& text = section_of(result, title).text;
    EXPECT_TRUE(std::ranges::any_of(text, [](const std::string& part) {
      return part.find(list_draws_otherwise) != std::string::npos;
    })) << title;
  }
}

TEST(PaperClaims, rule_verdict_and_what_is_wanted_agree) {
  constexpr RatioRule large{1.5, 1.1}, small{1.1, 1.5};
  EXPECT_EQ(large.judge(1.5), Verdict::confirmed);
  EXPECT_EQ(large.judge(1.3), Verdict::undecided);
  EXPECT_EQ(large.judge(1.1), Verdict::refuted);
  EXPECT_EQ(small.judge(1.1), Verdict::confirmed);
  EXPECT_EQ(small.judge(1.3), Verdict::undecided);
  EXPECT_EQ(small.judge(1.5), Verdict::refuted);
  EXPECT_EQ(large.text(), "confirmed from 1.5 times on, refuted up to 1.1 times");
  EXPECT_EQ(small.text(), "confirmed up to 1.1 times, refuted from 1.5 times on");
  EXPECT_EQ(large.wanted(Verdict::confirmed), "wanted at least 1.5 times");
  EXPECT_EQ(large.wanted(Verdict::refuted), "wanted at most 1.1 times");
  EXPECT_EQ(small.wanted(Verdict::confirmed), "wanted at most 1.1 times");
  EXPECT_EQ(small.wanted(Verdict::refuted), "wanted at least 1.5 times");
}

TEST(PaperAnalysis, two_rounds_lie_at_the_ends_of_their_bar) {
  SettingFound two = setting(32, 10.0);
  two.draw_ms = {14.0, 10.0};
  EXPECT_DOUBLE_EQ(draw_ms_of(two) - half_spread(two.draw_ms), 10.0);
  EXPECT_DOUBLE_EQ(draw_ms_of(two) + half_spread(two.draw_ms), 14.0);
  EXPECT_DOUBLE_EQ(median_of({3.0, 1.0, 9.0}), 3.0);
  EXPECT_DOUBLE_EQ(median_of({7.0}), 7.0);
  EXPECT_DOUBLE_EQ(median_of({}), 0.0);
}

TEST(PaperAnalysis, times_rise_steadily_if_no_step_falls_far_and_the_last_is_longer) {
  const SweepFound nearly{"s", {setting(1, 10.0), setting(2, 9.8), setting(3, 12.0)}};
  EXPECT_NEAR(least_step(nearly), 0.98, 1e-9);
  EXPECT_TRUE(rises_steadily(nearly, 0.95));
  EXPECT_FALSE(rises_steadily(nearly, 0.99));
  EXPECT_FALSE(rises_steadily({"s", {setting(1, 10.0), setting(2, 9.8)}}, 0.95));
}

TEST(PaperAnalysis, a_spike_is_measured_against_its_neighbours) {
  const Spikes spikes = spikes_of(rebuild_session("mesh", 2.0, 10.0), 3.0, bodies_of);
  EXPECT_EQ(spikes.ticks, 12U);
  EXPECT_DOUBLE_EQ(spikes.median_ratio, 4.0);
  EXPECT_DOUBLE_EQ(spikes.median_extra_ms, 1.5);
  EXPECT_EQ(spikes_of(session("none", 2.0, [](int, SessionTick&) {}), 0.0, bodies_of).ticks, 0U);
}

TEST(PaperAnalysis, sizes_between_settings_lie_on_the_power_law) {
  const SweepFound sweep{"s", {setting(32, 10.0), setting(64, 40.0)}};
  EXPECT_NEAR(exponent_between(sweep, draw_ms_of), 2.0, 1e-9);
  EXPECT_NEAR(size_at(sweep, 2.0 * draw_ms_of(sweep.settings.front())).value(), 32.0 * std::sqrt(2.0), 1e-6);
  EXPECT_FALSE(size_at(sweep, 5.0).has_value());
  EXPECT_FALSE(size_at(sweep, 100.0).has_value());
}

}  // namespace
}  // namespace scree::paper
