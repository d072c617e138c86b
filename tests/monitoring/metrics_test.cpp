// /metrics of a server that has worked: what it says, and that promtool finds nothing wrong with it.
#include <gtest/gtest.h>

#include "tests/monitoring/worked_server.h"
#include "tests/support/holds.h"
#include "tests/support/run_program.h"

namespace scree {
namespace {

TEST(Metrics, tell_what_the_server_has_done) {
  WorkedServer worked;
  ASSERT_NO_FATAL_FAILURE(worked.work());
  Samples samples = samples_of(worked.page());
  const ServerReport report = worked.server->report();
  const auto is = [&](const std::string& sample) {
    EXPECT_TRUE(samples.contains(sample)) << sample;
    return samples[sample];
  };
  EXPECT_EQ(is("scree_ticks_total"), WorkedServer::ticks);
  EXPECT_EQ(is("scree_tick_duration_seconds_count"), WorkedServer::ticks);
  EXPECT_EQ(is("scree_tick_modelled_seconds_count"), WorkedServer::ticks);
  EXPECT_GT(is("scree_tick_modelled_seconds_sum"), 0.0);
  EXPECT_EQ(is("scree_tick_stage_duration_seconds_count{stage=\"bodies\"}"), WorkedServer::ticks);
  EXPECT_EQ(is("scree_tick_rate_hertz"), 60);
  EXPECT_GT(is("scree_tick_budget_seconds_total"), 0.0);
  EXPECT_EQ(is("scree_requests_total"), 2);
  EXPECT_EQ(is("scree_requests_answered_total{answer=\"granted\"}"), 1);
  EXPECT_EQ(is("scree_requests_answered_total{answer=\"refused\"}"), 1);
  EXPECT_EQ(is("scree_refusals_total{reason=\"carve_invalid\"}"), 1);
  EXPECT_EQ(is("scree_refusals_total{reason=\"sessions_max\"}"), 0) << "a counter begins at 0";
  EXPECT_EQ(is("scree_operations_total{kind=\"carves\"}"), 1);
  EXPECT_EQ(is("scree_pieces_made_total"), static_cast<double>(report.pieces_made));
  EXPECT_GT(report.pieces_made, 0U);
  EXPECT_EQ(is("scree_ledger_error_cubic_meters"), 0);
  EXPECT_GT(is("scree_ledger_cubic_meters{place=\"moved\"}"), 1.0) << "a ball of 1 m in rubble or rock";
  EXPECT_EQ(is("scree_sessions{role=\"builder\"}"), 1);
  EXPECT_EQ(is("scree_joins_total{how=\"new\"}"), 1);
  EXPECT_EQ(is("scree_messages_total{direction=\"in\",kind=\"hello\"}"), 1);
  EXPECT_EQ(is("scree_messages_total{direction=\"in\",kind=\"carve\"}"), 2);
  EXPECT_EQ(is("scree_messages_total{direction=\"out\",kind=\"welcome\"}"), 1);
  EXPECT_EQ(is("scree_messages_total{direction=\"out\",kind=\"reply\"}"), 2);
  EXPECT_GT(is("scree_message_bytes_total{direction=\"out\",kind=\"frame\"}"), 100.0);
  EXPECT_GT(is("scree_frame_age_seconds_count"), 0);
  EXPECT_EQ(is("scree_request_duration_seconds_count{stage=\"tick\"}"), 2);
  EXPECT_GT(is("scree_chunks{place=\"memory\"}"), 0);
  EXPECT_EQ(is("scree_saving_failing"), 0);
  EXPECT_GT(is("scree_save_duration_seconds_count"), 0);
  EXPECT_GT(is("scree_saved_bytes_total"), 0);
  EXPECT_EQ(is("scree_recording_failing"), 0);
  EXPECT_GT(is("scree_recorded_ticks_total") + is("scree_recording_waiting_ticks"), 0);
  EXPECT_GT(is("scree_disk_free_bytes{file=\"world\"}"), 1e6);
  EXPECT_GT(is("scree_events_written_total"), 0);
  EXPECT_GT(is("process_resident_memory_bytes"), 1e6);
  EXPECT_EQ(is("scree_memory_max_bytes"), 4096.0 * 1024 * 1024);
  EXPECT_EQ(is("scree_work_ratio"), worked.config.world.work_percent / 1e2);
  EXPECT_GT(is("scree_rules_memory_bytes{rules=\"shop\"}"), 0);
  EXPECT_GE(is("scree_rules_calls_total{rules=\"shop\"}"), WorkedServer::ticks / 2);
  EXPECT_EQ(is("scree_healthy{path=\"healthz\"}"), 1);
}

TEST(Metrics, of_one_page_grow_until_the_next) {
  WorkedServer worked;
  ASSERT_NO_FATAL_FAILURE(worked.work());
  const Samples before = samples_of(worked.page());
  ASSERT_TRUE(worked.server->step_once());
  const Samples after = samples_of(worked.page());
  EXPECT_EQ(after.at("scree_ticks_total"), before.at("scree_ticks_total") + 1);
  for (const auto& [sample, value] : before) {
    if (sample.find("_total") == std::string::npos && sample.find("_bucket") == std::string::npos) continue;
    ASSERT_TRUE(after.contains(sample)) << sample;
    EXPECT_GE(after.at(sample), value) << sample;
  }
}

TEST(Metrics, have_nothing_that_promtool_complains_about) {
  WorkedServer worked;
  ASSERT_NO_FATAL_FAILURE(worked.work());
  const std::string path = worked.folder() / "metrics.txt";
  std::ofstream(path) << worked.page();
  const auto [status, said] = run_program(PROMTOOL " check metrics <" + path);
  EXPECT_EQ(status, 0) << said;
  EXPECT_EQ(said, "");
}

TEST(Metrics, promtool_complains_about_a_bad_name) {
  const TestFolder folder;
  std::ofstream(folder / "metrics.txt")
      << "# HELP scree_ticks Ticks.\n# TYPE scree_ticks counter\nscree_ticks 1\n";
  const auto [status, said] = run_program(PROMTOOL " check metrics <" + (folder / "metrics.txt"));
  EXPECT_NE(status, 0);
  EXPECT_TRUE(holds(said, "_total")) << said;
}

TEST(Metrics, are_few_enough_and_name_nobody) {
  WorkedServer worked;
  ASSERT_NO_FATAL_FAILURE(worked.work());
  const std::string page = worked.page();
  EXPECT_LT(samples_of(page).size(), 1000U) << "each is a series that Prometheus keeps";
  EXPECT_FALSE(holds(page, "127.0.0.1"));
  EXPECT_FALSE(holds(page, "hill.world"));
}

TEST(Metrics, of_a_replay_are_there) {
  WorkedServer worked;
  ASSERT_NO_FATAL_FAILURE(worked.work());
  ASSERT_TRUE(worked.server->stop());
  LiveConfig replay;
  replay.pacing = Pacing::by_hand;
  replay.replay.path = worked.config.record_path;
  worked.server = *LiveServer::start(replay);
  ASSERT_TRUE(worked.server->step_once());
  const Samples samples = samples_of(worked.page());
  EXPECT_EQ(samples.at("scree_replay"), 1);
  EXPECT_EQ(samples.at("scree_ticks_total"), 1);
  EXPECT_FALSE(samples.contains("scree_saving_failing")) << "there is no world to keep";
}

}  // namespace
}  // namespace scree
