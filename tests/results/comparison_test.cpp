// What became better and what worse between two results; noise decides what is the same.
#include "bench/results/comparison.h"

#include <gtest/gtest.h>
#include <limits>

#include "bench/results/metric_sense.h"

namespace scree {
namespace {

StoredResult result_of(std::map<std::string, MetricRange> metrics, uint32_t runs = 3) {
  StoredResult result{.name = "carve", .runs = runs};
  result.metrics = std::move(metrics);
  return result;
}

Change change_of(const std::string& metric, MetricRange before, MetricRange after, uint32_t runs = 3) {
  const auto comparison =
      compare_results(result_of({{metric, before}}, runs), result_of({{metric, after}}, runs));
  EXPECT_TRUE(comparison);
  EXPECT_EQ(comparison->metrics.size(), 1U);
  return comparison->metrics.front().change;
}

TEST(MetricSenseTest, the_unit_says_which_way_is_better) {
  for (const char* metric :
       {"tick_p99_ms", "ms", "frame_us", "join_all_s", "carve_bytes", "written_bytes_per_carve",
        "raymarch_gpu_mib", "session_mb_a_minute", "viewer_kbit_s", "kib_a_viewer",
        "atlas_update_us_a_carve_of_100", "search_us_per_part", "codes_volume_error",
        "stamp_surface_rms_voxels", "late_ticks", "off_mm", "world_size_exponent"})
    EXPECT_EQ(sense_of(metric).better, Better::lower) << metric;
  for (const char* metric : {"million_quads_per_s", "carves_per_s", "stamp_times_faster", "peer_to_own",
                             "capacity_bots", "honest_accepted_percent", "two_threads_ticks_ratio"})
    EXPECT_EQ(sense_of(metric).better, Better::higher) << metric;
}

TEST(MetricSenseTest, of_counts_and_peers_nobody_knows) {
  for (const char* metric :
       {"carves", "pieces_per_carve", "cores", "openvdb_median_ms", "peer_segment_sdf_median_ms",
        "csg_list_10_carves_frame_ms", "forms", "session_minutes", ""})
    EXPECT_EQ(sense_of(metric).better, Better::unknown) << metric;
}

/// Names as benches and studies write them.
TEST(MetricSenseTest, of_figures_beside_peers_ours_have_a_sense_and_theirs_none) {
  for (const char* metric :
       {"own_work_median_ms", "own_openvdb_carve_own_work_median_ms",
        "own_openvdb_recombine_stamp_us_a_piece", "own_bullet_storm_step_ms", "own_luanti_idle_cpu_cores",
        "own_luanti_viewer_mib", "own_zstd_carve_bytes", "own_nanovdb_gpu_mib"})
    EXPECT_EQ(sense_of(metric).better, Better::lower) << metric;
  for (const char* metric :
       {"own_nanovdb_million_rays_per_s", "own_openvdb_mesh_million_quads_per_s",
        "ratio_openvdb_carve_own_work_median_ms", "ratio_openvdb_recombine_stamp_us_a_piece",
        "ratio_zstd_carve_bytes", "ratio_nanovdb_million_rays_per_s", "ratio_luanti_join_s", "peer_to_own"})
    EXPECT_EQ(sense_of(metric).better, Better::higher) << metric;
  for (const char* metric :
       {"peer_openvdb_carve_own_work_median_ms", "peer_bullet_storm_step_ms", "peer_bullet_rebuild_ms",
        "peer_nanovdb_million_rays_per_s", "peer_luanti_late_step_ms", "peer_zstd_carve_bytes", "peer_leaves",
        "openvdb_us_a_piece", "openvdb_million_quads_per_s"})
    EXPECT_EQ(sense_of(metric).better, Better::unknown) << metric;
}

TEST(MetricSenseTest, of_studies_points_exponents_and_ratios_have_a_sense) {
  for (const char* metric : {"world_carve_ms_at_64", "voxel_islands_ms_at_0_25", "carves_start_ms_at_1e_06",
                             "world_bytes_of_a_join_mib_at_256", "viewers_sent_to_all_kbit_s_at_10",
                             "viewers_age_of_a_frame_median_ms_at_10", "recording_simulated_s_at_60",
                             "world_carve_exponent", "world_took_s", "machine_bot_ms_s", "grid_memory_ratio",
                             "raymarch_memory_ratio", "raymarch_draw_exponent", "preset_default_tick_p99_ms",
                             "field_alive_after_60_s", "rays_buried_at_the_end"})
    EXPECT_EQ(sense_of(metric).better, Better::lower) << metric;
  for (const char* metric : {"voxel_carve_exponent", "pieces_speed_up_by_all_cores_times_at_100",
                             "pieces_speed_up_by_all_cores_exponent", "machine_bots_on_two_cores"})
    EXPECT_EQ(sense_of(metric).better, Better::higher) << metric;
  for (const char* metric :
       {"voxel_pieces_of_a_blow_and_a_fall_count_at_0_25", "voxel_pieces_of_a_blow_and_a_fall_exponent",
        "world_carve_exponent_within", "grid_over_raymarch_full"})
    EXPECT_EQ(sense_of(metric).better, Better::unknown) << metric;
}

TEST(ComparisonTest, what_lies_within_both_spreads_is_the_same) {
  EXPECT_EQ(change_of("tick_ms", {10.0, 9.0, 11.0}, {13.9, 13.0, 15.0}), Change::same);
  EXPECT_EQ(change_of("tick_ms", {10.0, 9.0, 11.0}, {14.1, 13.0, 15.0}), Change::worse);
  EXPECT_EQ(change_of("tick_ms", {14.1, 13.0, 15.0}, {10.0, 9.0, 11.0}), Change::better);
}

TEST(ComparisonTest, a_clock_has_a_floor_below_which_nothing_counts) {
  EXPECT_EQ(change_of("tick_ms", {10.0, 10.0, 10.0}, {10.4, 10.4, 10.4}), Change::same);
  EXPECT_EQ(change_of("tick_ms", {10.0, 10.0, 10.0}, {10.6, 10.6, 10.6}), Change::worse);
  EXPECT_EQ(change_of("tick_ms", {0.003, 0.003, 0.003}, {0.0035, 0.0035, 0.0035}), Change::same);
}

TEST(ComparisonTest, what_is_counted_shows_small_changes) {
  EXPECT_EQ(change_of("carve_bytes", {49.0, 49.0, 49.0}, {50.0, 50.0, 50.0}), Change::worse);
  EXPECT_EQ(change_of("pieces", {49.0, 49.0, 49.0}, {50.0, 50.0, 50.0}), Change::changed);
  EXPECT_EQ(change_of("carves_per_s", {49.0, 49.0, 49.0}, {60.0, 60.0, 60.0}), Change::better);
}

TEST(ComparisonTest, few_runs_know_little_of_their_noise) {
  EXPECT_EQ(change_of("tick_ms", {10.0, 10.0, 10.0}, {12.4, 12.4, 12.4}, 1), Change::same);
  EXPECT_EQ(change_of("tick_ms", {10.0, 10.0, 10.0}, {12.6, 12.6, 12.6}, 1), Change::worse);
  const auto comparison = compare_results(result_of({}, 1), result_of({}, 3));
  ASSERT_TRUE(comparison);
  ASSERT_EQ(comparison->notes.size(), 1U);
  EXPECT_NE(comparison->notes[0].find("before has 1 of the 3 runs"), std::string::npos)
      << comparison->notes[0];
  EXPECT_NE(comparison->notes[0].find("--repeat 3"), std::string::npos) << comparison->notes[0];
}

TEST(ComparisonTest, studies_are_not_told_to_repeat) {
  StoredResult study = result_of({}, 1);
  study.kind = ResultKind::study;
  const auto comparison = compare_results(study, study);
  ASSERT_TRUE(comparison);
  ASSERT_EQ(comparison->notes.size(), 2U);
  EXPECT_EQ(comparison->notes[0].find("--repeat"), std::string::npos) << comparison->notes[0];
}

TEST(ComparisonTest, a_figure_that_was_zero_is_compared) {
  EXPECT_EQ(change_of("refused", {0.0, 0.0, 0.0}, {4.0, 4.0, 4.0}), Change::worse);
  EXPECT_EQ(change_of("refused", {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}), Change::same);
  EXPECT_EQ((MetricChange{"refused", MetricRange{}, MetricRange{4.0, 4.0, 4.0}}).ratio(), std::nullopt);
}

TEST(ComparisonTest, a_number_that_is_none_any_more_is_worse) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(change_of("tick_ms", {nan, nan, nan}, {nan, nan, nan}), Change::same);
  EXPECT_EQ(change_of("tick_ms", {1.0, 1.0, 1.0}, {nan, nan, nan}), Change::worse);
  EXPECT_EQ(change_of("pieces", {1.0, 1.0, 1.0}, {nan, nan, nan}), Change::worse);
  EXPECT_EQ(change_of("tick_ms", {nan, nan, nan}, {1.0, 1.0, 1.0}), Change::changed);
}

TEST(ComparisonTest, metrics_that_come_and_go_are_named) {
  const auto comparison =
      compare_results(result_of({{"old_ms", {1.0, 1.0, 1.0}}}), result_of({{"young_ms", {1.0, 1.0, 1.0}}}));
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->metrics[0].change, Change::gone);
  EXPECT_EQ(comparison->metrics[1].change, Change::added);
  EXPECT_FALSE(comparison->is_worse());
  EXPECT_TRUE(comparison->lacks_something());
  const auto nothing_gone = compare_results(result_of({}), result_of({{"young_ms", {1.0, 1.0, 1.0}}}));
  ASSERT_TRUE(nothing_gone);
  EXPECT_FALSE(nothing_gone->lacks_something());
}

TEST(ComparisonTest, a_check_that_is_missed_now_is_worse) {
  StoredResult before = result_of({}), after = result_of({});
  before.checks = {{"a", {true, ""}}, {"b", {false, ""}}, {"c", {true, ""}}, {"d", {true, ""}}};
  after.checks = {{"a", {false, "too slow"}}, {"b", {true, ""}}, {"c", {true, ""}}, {"d", {true, ""}}};
  const auto comparison = compare_results(before, after);
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->checks[0].change, Change::worse);
  EXPECT_EQ(comparison->checks[1].change, Change::better);
  EXPECT_EQ(comparison->checks[2].change, Change::same);
  EXPECT_EQ(comparison->checks[3].change, Change::same);
  EXPECT_TRUE(comparison->is_worse());
  EXPECT_NE(text_of(*comparison).find("too slow"), std::string::npos);
}

TEST(ComparisonTest, a_check_that_is_gone_or_new_and_missed_is_worse) {
  const auto compared = [](std::map<std::string, StoredCheck> was, std::map<std::string, StoredCheck> is) {
    StoredResult before = result_of({}), after = result_of({});
    before.checks = std::move(was);
    after.checks = std::move(is);
    return compare_results(before, after)->checks.front();
  };
  const std::map<std::string, StoredCheck> passed = {{"a", {true, "12 of 12"}}},
                                           missed = {{"a", {false, "too slow"}}};
  EXPECT_EQ(compared(passed, {}).change, Change::worse);
  EXPECT_EQ(compared(passed, {}).detail, "not checked any more; before: 12 of 12");
  EXPECT_EQ(compared(missed, {}).change, Change::gone);
  EXPECT_EQ(compared({}, missed).change, Change::worse);
  EXPECT_EQ(compared({}, passed).change, Change::added);
}

TEST(ComparisonTest, different_work_is_refused) {
  StoredResult other = result_of({});
  other.name = "storm";
  EXPECT_FALSE(compare_results(result_of({}), other));
  other = result_of({});
  other.kind = ResultKind::study;
  EXPECT_FALSE(compare_results(result_of({}), other));
  other = result_of({});
  other.options["quick"] = "yes";
  const auto refused = compare_results(result_of({}), other);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("quick yes"), std::string::npos) << refused.error().message;
}

TEST(ComparisonTest, another_machine_is_told_and_no_hindrance) {
  StoredResult before = result_of({}), after = result_of({});
  before.machine = {"a slow one", 2, 8.0, "g++", "Linux"};
  after.machine = {"a fast one", 2, 8.0, "g++", "Linux"};
  after.conditions["gl_renderer"] = "some card";
  const auto comparison = compare_results(before, after);
  ASSERT_TRUE(comparison);
  ASSERT_EQ(comparison->notes.size(), 2U);
  EXPECT_NE(comparison->notes[0].find("a slow one"), std::string::npos);
  EXPECT_NE(comparison->notes[1].find("some card"), std::string::npos);
}

}  // namespace
}  // namespace scree
