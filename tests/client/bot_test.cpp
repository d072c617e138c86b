// The bot against a whole server in the same process, stepped by hand: what it asks, sees, survives and
// reports.
#include "client/bot/bot.h"

#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

#include "client/bot/limits.h"
#include "server/app/live_server.h"
#include "shared/base/quantile.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/raw_server.h"

namespace scree {
namespace {

using namespace std::chrono_literals;

/// By slanted looks, too, which see far on a canyon's sides.
TEST(Carver, carves_within_its_square) {
  MapField field(TerrainSource{TerrainKind::canyon, 1, 0.25F});
  for (const float area_m : {0.0F, 5.0F}) {
    Carver carver({.centre_m = {10.0F, 0.0F, -8.0F}, .area_m = area_m}, 7);
    for (uint32_t i = 0; i < 60; ++i) {
      const glm::vec3 place_m = carver.carve(carver.aim(field), i).impact_m;
      EXPECT_NEAR(place_m.x, 10.0F, area_m + 0.011F);
      EXPECT_NEAR(place_m.z, -8.0F, area_m + 0.011F);
    }
  }
}

class BotTest : public ::testing::Test {
 protected:
  void SetUp() override {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.pacing = Pacing::by_hand;
    config.world.service.requests_per_second = 1000.0;  // else a bot at full speed is refused some in no time
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server_ = std::move(*started);
  }

  BotConfig config(uint32_t carves) const {
    BotConfig bot;
    bot.port = server_->port();
    bot.carves = carves;
    bot.rate_hz = 0.0;
    bot.carver.area_m = 6.0F;
    bot.carver.radius_m = 1.0F;
    bot.carver.seeds = 12;
    return bot;
  }

  /// Server and bot in turns until the condition holds; false when that takes too long or the bot gives up.
  template <typename F>
  bool go_on_until(Bot& bot, F&& condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end || !server_->step_once()) return false;
      if (!bot.step(1ms)) return false;
    }
    return true;
  }
  bool finish(Bot& bot) {
    return go_on_until(bot, [&] { return bot.finished(); });
  }

  std::unique_ptr<LiveServer> server_;
};

TEST_F(BotTest, carves_until_everything_has_settled_and_the_hashes_are_equal) {
  BotConfig with_linger = config(4);
  with_linger.linger = true;
  Bot bot(with_linger);
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(finish(bot));
  const BotReport report = bot.report();
  EXPECT_EQ(report.failure, "");
  EXPECT_EQ(report.carves_asked, 4U);
  EXPECT_EQ(report.carves_accepted, 4U);
  EXPECT_TRUE(report.settled);
  EXPECT_TRUE(report.hash.equal);
  EXPECT_GT(report.seen.pieces_made, 4U);
  EXPECT_EQ(report.seen.pieces_merged + report.seen.operations.of<DiscardOperation>(),
            report.seen.pieces_made);
  EXPECT_EQ(report.pieces_alive, 0U);
  EXPECT_EQ(report.seen.mismatches, 0U);
  EXPECT_EQ(report.edit_latencies_ms.size(), 4U);
  EXPECT_EQ(report.connections, 1U);
  EXPECT_LE(report.costs.of<CarveOperation>().bytes_worst, 200.0);
  EXPECT_LE(report.costs.of<StampOperation>().bytes_worst, 32.0);
}

TEST_F(BotTest, authored_and_clustered_seeds_leave_both_sides_the_same_terrain) {
  for (const SeedPattern pattern : {SeedPattern::authored, SeedPattern::clustered}) {
    BotConfig patterned = config(2);
    patterned.carver.pattern = pattern;
    Bot bot(patterned);
    ASSERT_TRUE(bot.join());
    ASSERT_TRUE(finish(bot));
    EXPECT_EQ(bot.report().failure, "");
    EXPECT_EQ(bot.report().carves_accepted, 2U);
    EXPECT_GT(bot.report().seen.pieces_made, 2U);
    EXPECT_TRUE(bot.report().hash.equal);
  }
}

TEST_F(BotTest, without_a_place_it_carves_before_the_eyes_of_who_begins_in_the_world) {
  LiveConfig live;
  live.world.terrain = flat_terrain;
  live.world.spawn = Spawn{{200.0F, 6.0F, 50.0F}, 90.0F, -10.0F};  // it looks along −x
  live.pacing = Pacing::by_hand;
  auto started = LiveServer::start(live);
  ASSERT_TRUE(started) << started.error().message;
  server_ = std::move(*started);
  BotConfig carving = config(2);
  carving.at_spawn = true;
  Bot bot(carving);
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(finish(bot)) << bot.report().failure;
  ASSERT_EQ(bot.report().carves_accepted, 2U);
  const float chunk_m = static_cast<float>(chunk_size) * flat_terrain.voxel_size_m;
  const auto chunks = bot.mirror()->field().edited_chunks();
  ASSERT_FALSE(chunks.empty());
  for (const ChunkCoord chunk : chunks) {
    EXPECT_NEAR(static_cast<float>(chunk.x) * chunk_m, 200.0F - limits::bot_ahead_m, 20.0F);
    EXPECT_NEAR(static_cast<float>(chunk.z) * chunk_m, 50.0F, 40.0F);  // pieces fly to the sides
  }
}

TEST_F(BotTest, no_carves_is_a_check_that_the_server_answers) {
  Bot bot(config(0));
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(finish(bot));
  EXPECT_EQ(bot.report().failure, "");
  EXPECT_EQ(bot.report().carves_asked, 0U);
}

TEST_F(BotTest, asks_no_more_while_many_requests_wait_for_their_replies) {
  Bot bot(config(3 * limits::bot_requests_waiting_max));
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(server_->step_once());
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (bot.report().carves_asked == 0 && std::chrono::steady_clock::now() < end) ASSERT_TRUE(bot.step(1ms));
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(bot.step(1ms));
  EXPECT_EQ(bot.report().carves_asked, limits::bot_requests_waiting_max);
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.report().carves_asked > limits::bot_requests_waiting_max; }));
}

TEST_F(BotTest, refusals_are_counted_by_reason) {
  BotConfig too_large = config(3);
  too_large.carver.radius_m = 100.0F;
  Bot bot(too_large);
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.report().carves_refused == 3; }));
  const BotReport report = bot.report();
  EXPECT_EQ(report.carves_accepted, 0U);
  EXPECT_EQ(report.refusals, (std::map<std::string, uint32_t>{{"carve_invalid", 3}}));
}

TEST_F(BotTest, a_cut_connection_is_made_anew_and_ends_with_the_same_hash) {
  Bot bot(config(6));
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.report().carves_accepted >= 3; }));
  bot.connection()->abort();
  ASSERT_TRUE(finish(bot));
  const BotReport report = bot.report();
  EXPECT_EQ(report.connections, 2U);
  EXPECT_EQ(report.carves_accepted + report.carves_lost, 6U);
  EXPECT_TRUE(report.hash.equal);
  EXPECT_EQ(report.seen.mismatches, 0U);
  EXPECT_GT(report.seen.chunks, 0U) << "what had been edited before came whole";
}

TEST_F(BotTest, damage_in_the_copy_is_found_by_the_checks_and_repaired) {
  BotConfig apart = config(20);
  apart.carver.area_m = 25.0F;
  Bot bot(apart);
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.report().carves_accepted >= 2; }));
  Field& field = bot.mirror()->field();
  for (const ChunkCoord chunk : field.edited_chunks())
    field.set_brick(field.edited_bricks(chunk).front(), solid_brick());
  ASSERT_TRUE(finish(bot));
  const BotReport report = bot.report();
  EXPECT_GT(report.seen.mismatches, 0U);
  EXPECT_GT(report.seen.repairs_arrived, 0U);
  EXPECT_EQ(report.connections, 1U);
}

TEST_F(BotTest, a_bot_all_of_whose_carves_are_refused_says_so) {
  BotConfig far_too_large = config(2);
  far_too_large.carver.radius_m = 1000.0F;
  Bot bot(far_too_large);
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(finish(bot));
  const BotReport report = bot.report();
  EXPECT_EQ(report.carves_refused, 2U);
  const std::string told = all_refused(report);
  EXPECT_NE(told.find("every carve was refused: "), std::string::npos) << told;
  EXPECT_NE(told.find("(2)"), std::string::npos) << told;
  BotReport some = report;
  some.carves_accepted = 1;
  EXPECT_EQ(all_refused(some), "");
  EXPECT_EQ(all_refused(BotReport{}), "");
}

TEST_F(BotTest, the_report_is_json_that_programs_can_read) {
  Bot bot(config(1));
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(finish(bot));
  const auto json = nlohmann::json::parse(to_json(bot.report()));
  EXPECT_TRUE(json.at("ok").get<bool>());
  EXPECT_EQ(json.at("carves").at("accepted"), 1);
  EXPECT_EQ(json.at("hash").at("equal"), true);
  EXPECT_EQ(json.at("ledger").at("error"), 0);
  const auto& stages = json.at("reply_stages_ms");
  EXPECT_EQ(stages.at("network").at("count"), 1);
  double sum_ms = stages.at("network").at("worst").get<double>();
  for (const LatencyStageRow& stage : latency_stages)
    sum_ms += stages.at(stage.name).at("worst").get<double>();
  EXPECT_NEAR(sum_ms, json.at("reply_latency_ms").at("worst").get<double>(), 0.5) << "nothing is left over";
  EXPECT_EQ(json.at("terrain").at("kind"), "flat");
  EXPECT_GT(json.at("bytes").at("received").get<uint64_t>(), 0U);
}

TEST(Bot, a_server_that_is_not_there_is_a_failure_in_words) {
  BotConfig nobody;
  const RawServer closed = RawServer::closed();
  nobody.port = closed.port();
  const BotReport report = Bot(nobody).run();
  EXPECT_NE(report.failure.find("cannot connect"), std::string::npos) << report.failure;
  EXPECT_NE(to_json(report).find("\"ok\": false"), std::string::npos);
}

TEST(Bot, quantiles_are_values_of_the_list) {
  EXPECT_EQ(quantile({}, 0.5), 0.0);
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.0), 1.0);
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 1.0), 3.0);
}

TEST_F(BotTest, a_server_that_refuses_without_end_cannot_fill_its_log) {
  std::map<std::string, int> lines;
  BotConfig refused = config(200);
  refused.carver.radius_m = 1000.0F;  // over every server's limit
  Bot bot(refused, [&](const std::string& line) { ++lines[line.substr(0, line.find(' '))]; });
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.report().carves_refused == 200; }));
  EXPECT_GE(lines["carve"], static_cast<int>(limits::log_lines_burst));
  EXPECT_LE(lines["carve"], static_cast<int>(limits::log_lines_burst + 62 * limits::log_lines_per_second));
  EXPECT_LT(lines["carve"], 150) << "200 were refused";
  EXPECT_EQ(lines["connected"], 1);
}

}  // namespace
}  // namespace scree
