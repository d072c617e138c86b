// Five made-up incidents, and what the flight recorder says of each; what it keeps, and what it writes.
#include "server/flight/diagnosis.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "proto/limits.h"
#include "server/flight/flight_recorder.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

constexpr SlowLimits limits_of_test{50.0, 1000.0};
constexpr uint8_t carve_kind = 0;

FlightNames names() {
  return {[](uint64_t session) { return session == 7 ? std::string("Ann") : std::string(); },
          [](uint8_t) { return std::string_view("carve"); }};
}

/// A tick as most are.
FlightTick quiet(Tick tick = 1) {
  FlightTick quiet;
  quiet.tick = tick;
  quiet.unix_ms = 1'000'000 + tick * 16;
  quiet.tick_ms = 1e3F / 60.0F;
  quiet.wall_ms = 2.0F;
  quiet.world_ms = 1.5F;
  quiet.thread_cpu_ms = 1.9F;
  quiet.process_cpu_ms = 2.5F;
  quiet.net_busy_ms = 0.2F;
  quiet.net_cpu_ms = 0.2F;
  return quiet;
}

/// One that worked for so long, most of it in that stage.
FlightTick working(float ms, TickStage stage) {
  FlightTick tick = quiet();
  tick.wall_ms = tick.thread_cpu_ms = tick.process_cpu_ms = ms;
  tick.world_ms = tick.stage_ms[index_of(stage)] = ms - 1.0F;
  tick.model_ms[index_of(stage)] = 9.0F;
  return tick;
}

std::string said(const FlightTick& tick, std::span<const FlightCause> causes = {}) {
  const Diagnosis found = diagnose(tick, causes, limits_of_test);
  return std::string(name_of(found.culprit)) + ": " + words_of(tick, found, names());
}

TEST(Diagnosis, a_tick_in_time_has_no_culprit) {
  EXPECT_EQ(diagnose(quiet(), {}, limits_of_test).culprit, Culprit::none);
  EXPECT_EQ(diagnose(working(60.0F, TickStage::bodies), {}, limits_of_test).culprit, Culprit::none)
      << "43 ms late";
}

TEST(Diagnosis, a_heavy_carver_is_named_with_place_time_and_price) {
  const FlightTick tick = working(120.0F, TickStage::requests);
  const std::array causes{
      FlightCause{.party = 3, .session = 3, .request = carve_kind, .count = 1, .clock_ms = 4.0F},
      FlightCause{.party = 7,
                  .session = 7,
                  .request = carve_kind,
                  .count = 5,
                  .clock_ms = 110.0F,
                  .price_ms = 11.0F,
                  .place_m = {3.0F, 4.0F, 5.0F}},
      FlightCause{.party = 3, .stage = TickStage::recombine, .count = 9, .clock_ms = 500.0F}};
  EXPECT_EQ(said(tick, causes),
            "work: 5 carve of Ann (session 7) at (3, 4, 5) took 110 ms of the stage requests, "
            "11 ms by their price");
}

TEST(Diagnosis, hulls_are_their_carvers_and_later_work_is_its_partys) {
  const std::array carve{
      FlightCause{.party = 7, .session = 7, .request = carve_kind, .count = 1, .clock_ms = 3.0F}};
  EXPECT_TRUE(holds(said(working(120.0F, TickStage::spawn), carve), "1 carve of Ann"));
  const std::array merge{
      FlightCause{.party = 7, .stage = TickStage::recombine, .count = 9, .clock_ms = 100.0F}};
  EXPECT_TRUE(holds(said(working(120.0F, TickStage::recombine), merge),
                    "9 operations on rock that Ann (session 7) broke"));
  EXPECT_TRUE(
      holds(said(working(120.0F, TickStage::islands)), "the stage islands took 119 ms, 9 ms by its price"));
}

TEST(Diagnosis, a_needle_forest_is_named_by_its_place_and_its_maker) {
  FlightTick tick = working(120.0F, TickStage::bodies);
  tick.pieces = 300;
  tick.contacts = 9000;
  tick.crowd = {250, {10.0F, 2.0F, -30.0F}, 7, 280};
  EXPECT_EQ(said(tick),
            "crowd: 300 pieces with 9000 contacts, 280 of them of Ann (session 7): they lie closest at "
            "(10, 2, -30), 250 within 4 m; the stage bodies took 119 ms");
  tick.crowd = {};
  EXPECT_TRUE(holds(said(tick), "work: the stage bodies")) << "there are few";
}

TEST(Diagnosis, a_slow_disk_is_named_by_what_waited_for_it) {
  FlightTick reading = quiet();
  reading.wall_ms = 300.0F;
  reading.world_ms = 299.0F;
  reading.chunk_waits = 2;
  EXPECT_EQ(said(reading),
            "disk: the disk was slow: the tick waited 2 times for terrain from the world's file");
  FlightTick recording = quiet();
  recording.wall_ms = 400.0F;
  recording.record_ms = 398.0F;
  EXPECT_EQ(said(recording), "disk: the disk was slow: the recording's queue was full for 398 ms");
  FlightTick saving = quiet();
  saving.save_ms = 2500.0F;
  EXPECT_EQ(said(saving), "disk: the disk was slow: a save took 2500 ms") << "though the tick was in time";
}

TEST(Diagnosis, a_network_thread_is_starved_or_has_too_much_to_do) {
  FlightTick starved = quiet();
  starved.net_lag_ms = 800.0F;
  EXPECT_TRUE(
      said(starved).starts_with("network: the network thread was starved: it took a tick 800 ms after it"));
  FlightTick busy = quiet();
  busy.wall_ms = 900.0F;
  busy.hand_over_ms = 890.0F;
  busy.net_busy_ms = busy.net_cpu_ms = 100.0F;
  busy.net_lag_ms = 50.0F;
  EXPECT_TRUE(said(busy).starts_with("network: the network thread had too much to do")) << said(busy);
}

TEST(Diagnosis, a_process_that_did_not_run_was_swapped_out_where_pages_came_from_the_disk) {
  FlightTick stopped = quiet();
  stopped.began_late_ms = 700.0F;
  EXPECT_TRUE(said(stopped).starts_with("not_running: the process did not run for 700 ms"));
  FlightTick within = quiet();
  within.wall_ms = within.world_ms = 700.0F;
  EXPECT_TRUE(said(within).starts_with("not_running: the process did not run for 698 ms")) << said(within);
  within.major_faults = 230;
  EXPECT_EQ(said(within),
            "swapped_out: the process was swapped out: it waited 698 ms for 230 pages from the disk");
  FlightTick helpers = working(120.0F, TickStage::bodies);
  helpers.thread_cpu_ms = 30.0F;
  helpers.process_cpu_ms = 400.0F;
  EXPECT_TRUE(said(helpers).starts_with("work: ")) << "its helpers ran meanwhile";
}

// ---- the recorder

class FlightRecorderTest : public ::testing::Test {
 protected:
  FlightRecorderTest() { restart(""); }
  void restart(const std::string& log) {
    auto opened = FlightRecorder::open(
        {.tick_rate_hz = 60, .slow = limits_of_test, .log_path = log, .request_name = [](uint8_t) {
           return std::string_view("carve");
         }});
    ASSERT_TRUE(opened) << opened.error().message;
    recorder = std::move(*opened);
    recorder->name(7, "Ann");
  }
  /// A tick in which session 7 carved for so long.
  void add_carve(Tick tick, float ms) {
    TickDelta delta;
    delta.tick = tick;
    delta.times[TickStage::requests] = ms;
    delta.costs = {{7, 7, carve_kind, 9000.0F, ms * 1e3F, {1.0F, 2.0F, 3.0F}}};
    FlightTick flight = quiet(tick);
    flight.wall_ms = flight.thread_cpu_ms = flight.process_cpu_ms = ms;
    recorder->add(flight, delta);
  }
  void add_quiet(Tick tick) {
    TickDelta delta;
    delta.tick = tick;
    recorder->add(quiet(tick), delta);
  }

  PartyWork work_of(uint64_t party) const {
    for (const PartyWork& work : recorder->parties())
      if (work.party == party) return work;
    ADD_FAILURE() << "no party " << party;
    return {};
  }

  std::unique_ptr<FlightRecorder> recorder;
};

TEST_F(FlightRecorderTest, slow_ticks_of_one_cause_that_follow_each_other_are_told_as_one) {
  add_quiet(1);
  add_carve(2, 100.0F);
  add_carve(3, 200.0F);
  add_carve(4, 150.0F);
  add_quiet(5);
  add_carve(500, 90.0F);
  const auto slow = recorder->slow(0);
  ASSERT_EQ(slow.size(), 2U);
  EXPECT_EQ(slow[0].ticks, 3U);
  EXPECT_EQ(slow[0].worst.tick, 3U);
  EXPECT_EQ(slow[0].name, "Ann");
  EXPECT_TRUE(holds(slow[0].words, "1 carve of Ann (session 7) at (1, 2, 3) took 200 ms")) << slow[0].words;
  EXPECT_EQ(recorder->slow(quiet(499).unix_ms).size(), 1U) << "since then";
}

TEST_F(FlightRecorderTest, the_worst_ticks_are_found_slow_or_not) {
  for (Tick tick = 1; tick <= 5000; ++tick) add_quiet(tick);
  add_carve(5001, 30.0F);
  add_carve(5002, 20.0F);
  const auto worst = recorder->worst(0, 2);
  ASSERT_EQ(worst.size(), 2U);
  EXPECT_EQ(worst[0].worst.tick, 5001U);
  EXPECT_EQ(worst[1].worst.tick, 5002U);
  EXPECT_TRUE(holds(worst[0].words, "carve of Ann")) << worst[0].words;
  EXPECT_TRUE(recorder->slow(0).empty());
}

TEST_F(FlightRecorderTest, memory_is_bounded) {
  for (Tick tick = 1; tick <= limits::flight_ticks_max + 100; ++tick)
    add_carve(tick, tick % 64 == 0 ? 99.0F : 1.0F);
  EXPECT_EQ(recorder->ticks_kept(), limits::flight_ticks_max);
  EXPECT_LE(recorder->slow(0).size(), limits::slow_rows_max);
  EXPECT_LT(FlightRecorder::bytes_max(), 15'000'000U);
  for (uint64_t session = 1; session <= limits::flight_names_max + 50; ++session)
    recorder->name(session, "x");
}

TEST_F(FlightRecorderTest, a_replay_that_jumps_back_begins_anew) {
  for (Tick tick = 1; tick <= 100; ++tick) add_quiet(tick);
  add_quiet(10);
  EXPECT_EQ(recorder->ticks_kept(), 1U);
}

TEST_F(FlightRecorderTest, work_by_party_is_an_average_of_the_last_seconds) {
  for (Tick tick = 1; tick <= 60 * 60; ++tick) add_carve(tick, 2.0F);
  const PartyWork ann = work_of(7);
  EXPECT_NEAR(ann.clock_us_per_s, 2000.0 * 60, 6000.0);
  EXPECT_NEAR(ann.price_us_per_s, 9000.0 * 60, 27000.0);
  EXPECT_EQ(ann.requests, 3600U);
  for (Tick tick = 3601; tick <= 3600 + 60 * 60; ++tick) add_quiet(tick);
  EXPECT_LT(work_of(7).clock_us_per_s, 1000.0);
}

TEST_F(FlightRecorderTest, pieces_count_for_who_broke_them_and_a_crowd_is_found) {
  TickDelta delta;
  delta.tick = limits::flight_piece_ticks;
  AppliedOperation carve;
  carve.party = 7;
  for (PieceId id = 1; id <= 40; ++id) {
    carve.created.push_back(id);
    const float x_m = id <= 30 ? 9.0F : 100.0F + 8.0F * static_cast<float>(id);
    delta.pieces.push_back({id, quantise({{x_m, 1.0F, 1.0F}, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)})});
  }
  delta.operations.push_back(carve);
  delta.times[TickStage::bodies] = 200.0;
  FlightTick slow = quiet(delta.tick);
  slow.wall_ms = slow.thread_cpu_ms = 201.0F;
  recorder->add(slow, delta);
  const auto rows = recorder->slow(0);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].diagnosis.culprit, Culprit::crowd);
  EXPECT_TRUE(
      holds(rows[0].words, "40 of them of Ann (session 7): they lie closest at (9, 1, 1), 30 within 4 m"))
      << rows[0].words;
  EXPECT_EQ(rows[0].name, "Ann");
  EXPECT_EQ(work_of(7).pieces, 40U);
  EXPECT_EQ(work_of(7).name, "Ann");
}

TEST_F(FlightRecorderTest, slow_ticks_are_lines_of_a_file_and_a_storm_of_them_is_bounded) {
  const TestFolder folder;
  const std::string path = folder / "slow.jsonl";
  restart(path);
  for (Tick tick = 1; tick <= 100; ++tick) add_carve(tick, 100.0F);
  add_carve(10'000, 300.0F);  // minutes later
  ASSERT_TRUE(recorder->finish());
  std::ifstream file(path);
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(lines.size(), 11U);
  EXPECT_EQ(lines.front().at("culprit"), "work");
  EXPECT_EQ(lines.front().at("stage_ms").at("requests"), 100.0);
  EXPECT_EQ(lines.front().at("causes").at(0).at("name"), "Ann");
  EXPECT_EQ(lines.front().at("causes").at(0).at("request"), "carve");
  EXPECT_EQ(lines.front().at("causes").at(0).at("price_ms"), 9.0);
  EXPECT_FALSE(lines.front().contains("left_out"));
  EXPECT_EQ(lines.back().at("left_out"), 90);
  EXPECT_EQ(lines.back().at("tick"), 10'000);
}

}  // namespace
}  // namespace scree
