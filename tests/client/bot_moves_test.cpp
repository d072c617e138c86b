// The bot's digs and places against a whole server in the same process, flying and on foot, and how it says
// what became of them.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "client/bot/bot.h"
#include "client/bot/random_walk.h"
#include "server/app/live_server.h"
#include "shared/field/field.h"
#include "tests/support/person_world.h"

namespace scree {
namespace {

TEST(PlacePlan, shares_are_of_what_there_is_most_of_and_never_more_than_all) {
  PlacePlan plan({{material::rock, 600}, {material::soil, 300}}, 3);
  EXPECT_EQ(plan.next(), (MaterialMass{material::rock, 300}));
  const MaterialMass second = plan.next(), third = plan.next();
  EXPECT_EQ(second.mass, 300);
  EXPECT_EQ(third.mass, 300);
  EXPECT_NE(second.material, third.material);
  EXPECT_EQ(plan.next().mass, 0) << "nothing is left";
  EXPECT_EQ(PlacePlan({}, 2).next().mass, 0);
}

TEST(PlacePlan, a_share_is_no_more_than_there_is_of_its_material) {
  PlacePlan plan({{material::rock, 60}, {material::soil, 50}, {material::ice, 40}}, 1);
  EXPECT_EQ(plan.next(), (MaterialMass{material::rock, 60}));
}

TEST(PlacePlan, a_ball_of_rubble_is_larger_than_its_rock_and_takes_nine_tenths_of_it) {
  const MassUnits mass = 254 * 64;  // a cubic metre of voxels of 0.25 m
  EXPECT_NEAR(ball_radius_m(mass, 128, 0.25F), std::cbrt(0.9 * 0.75 / 3.14159265), 1e-3);
  EXPECT_NEAR(ball_radius_m(mass, 64, 0.25F), std::cbrt(1.8 * 0.75 / 3.14159265), 1e-3);
  EXPECT_EQ(ball_radius_m(0, 79, 0.25F), 0.0F);
}

TEST(RandomWalk, turns_back_where_it_leaves_its_square) {
  constexpr float step_m = 0.1F;
  const WalkSquare square{{20.0F, 0.0F, -8.0F}, 4.0F};
  RandomWalk walk(50, 60, 3, square), free(50, 60, 3);
  glm::vec3 feet_m(20.0F, 3.0F, -8.0F), free_m = feet_m;
  float farthest_m = 0.0F;
  while (!walk.is_over()) {
    feet_m += step_m * walk.next(feet_m).go;
    free_m += step_m * free.next(free_m).go;
    EXPECT_TRUE((WalkSquare{square.middle_m, square.half_m + 2.0F * step_m}).has(feet_m));
    farthest_m = std::max(farthest_m, glm::distance(free_m, square.middle_m));
  }
  EXPECT_GT(farthest_m, 8.0F) << "without a square it goes far";
}

class BotMovesTest : public ::testing::Test {
 protected:
  void start(LiveConfig config) {
    config.world.spawn = Spawn{{0.0F, 2.0F, 0.0F}};
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server_ = std::move(*started);
  }
  static LiveConfig walking() {
    LiveConfig config;
    config.world = walking_world();
    return config;
  }
  static LiveConfig flying() {
    LiveConfig config;
    config.world = rock_world();
    return config;
  }
  BotConfig config(uint32_t digs, uint32_t places) const {
    BotConfig bot;
    bot.port = server_->port();
    bot.carves = 0;
    bot.digs = digs;
    bot.places = places;
    bot.rate_hz = 20.0;
    bot.carver.radius_m = 1.0F;
    bot.timeout_s = 60.0;
    bot.at_spawn = true;
    return bot;
  }
  /// The report, and every line that the bot logs.
  BotReport visit(const BotConfig& config) {
    lines_.clear();
    return Bot(config, [this](const std::string& line) { lines_.push_back(line); }).run();
  }
  size_t line_with(const std::string& words) const {
    for (size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].find(words) != std::string::npos) return i;
    return lines_.size();
  }

  std::unique_ptr<LiveServer> server_;
  std::vector<std::string> lines_;
};

/// Height of the highest ground near a place, metres; at most 5.
float heap_height_m(Field& field, float x_m, float z_m) {
  constexpr float from_m = 5.0F, around_m = 3.0F, step_m = 0.25F;
  const float dx = field.source().voxel_size_m;
  float height_m = -from_m;
  for (float x = -around_m; x <= around_m; x += step_m)
    for (float z = -around_m; z <= around_m; z += step_m)
      if (const auto down =
              trace(field, glm::vec3(x_m + x, from_m, z_m + z) / dx, {0.0F, -1.0F, 0.0F}, 2.0F * from_m / dx))
        height_m = std::max(height_m, from_m - *down * dx);
  return height_m;
}

/// What is carried is what was dug and not placed, to the unit.
void expect_balance(const BotReport& report, uint32_t digs, uint32_t places) {
  EXPECT_EQ(report.failure, "");
  EXPECT_EQ(report.digs.accepted, digs);
  EXPECT_EQ(report.places.accepted, places);
  EXPECT_GT(report.digs.mass, 0);
  EXPECT_GT(report.places.mass, report.digs.mass / 2) << "most of it is put down";
  MassUnits carried = 0;
  for (const auto& [material, mass] : report.carried) carried += mass;
  EXPECT_EQ(carried, report.digs.mass - report.places.mass);
  EXPECT_TRUE(report.hash.equal);
  EXPECT_EQ(report.seen.mismatches, 0U);
}

TEST_F(BotMovesTest, flying_it_digs_and_puts_down_most_of_it) {
  start(flying());
  BotConfig bot = config(6, 3);
  bot.check_hash = true;
  const BotReport report = visit(bot);
  expect_balance(report, 6, 3);
  EXPECT_EQ(all_refused(report), "");
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json.at("digs").at("mass"), report.digs.mass);
  EXPECT_EQ(json.at("places").at("accepted"), 3);
  EXPECT_NEAR(json.at("digs").at("m3").get<double>(), m3_of(report.digs.mass, report), 1e-9);
  EXPECT_EQ(json.at("carried").size(), report.carried.size());
  EXPECT_EQ(json.at("ledger").at("error"), 0);
}

TEST_F(BotMovesTest, it_puts_down_where_it_is_told_to) {
  start(flying());
  BotConfig wanted = config(4, 2);
  wanted.place_m = {30.0F, 0.0F, -20.0F};
  wanted.carver.area_m = 1.0F;
  wanted.check_hash = true;
  Bot bot(wanted);
  ASSERT_TRUE(bot.join());
  while (!bot.finished()) ASSERT_TRUE(bot.step(std::chrono::milliseconds(5)));
  expect_balance(bot.report(), 4, 2);
  Field& field = bot.mirror()->field();
  EXPECT_GT(heap_height_m(field, 30.0F, -20.0F), 0.5F);
  EXPECT_LT(heap_height_m(field, -30.0F, 20.0F), 0.1F);
}

TEST_F(BotMovesTest, carves_come_before_digs_and_places) {
  start(flying());
  BotConfig bot = config(2, 1);
  bot.carves = 2;
  bot.linger = true;
  const BotReport report = visit(bot);
  EXPECT_EQ(report.failure, "");
  EXPECT_EQ(report.carves_accepted, 2U);
  EXPECT_EQ(report.digs.accepted, 2U);
  EXPECT_EQ(report.places.asked, 1U);
  EXPECT_TRUE(report.settled);
}

/// The square of its carves lies 22 m ahead: on foot it works where it is.
TEST_F(BotMovesTest, on_foot_it_digs_and_places_within_a_short_reach) {
  LiveConfig live = walking();
  live.world.service.reach_m = 8.0;
  start(live);
  BotConfig bot = config(4, 2);
  bot.walks = 2;
  bot.carver.radius_m = 0.8F;
  const BotReport report = visit(bot);
  expect_balance(report, 4, 2);
  EXPECT_EQ(report.walks.done, 2U);
  EXPECT_EQ(report.walks.refused, 0U);
}

TEST_F(BotMovesTest, refusals_are_counted_by_reason_and_said) {
  start(flying());
  BotReport report = visit(config(0, 2));
  EXPECT_EQ(report.places.refused, 2U);
  EXPECT_EQ(report.places.refusals, (std::map<std::string, uint32_t>{{"store_lacks", 2}}));
  EXPECT_EQ(all_refused(report), "every place was refused: store_lacks (2)");
  EXPECT_LT(line_with("place 1 was refused (store_lacks)"), lines_.size());
  BotConfig large = config(2, 1);
  large.carver.radius_m = 100.0F;
  report = visit(large);
  EXPECT_EQ(report.digs.refused, 2U);
  EXPECT_EQ(all_refused(report).find("every dig and every place was refused: "), 0U) << all_refused(report);
  report.digs.accepted = 1;
  EXPECT_EQ(all_refused(report), "");
}

TEST_F(BotMovesTest, a_world_in_which_nobody_may_dig_says_why) {
  LiveConfig live = flying();
  live.world.store_m3 = 0;
  start(live);
  const BotReport report = visit(config(1, 0));
  EXPECT_EQ(report.digs.refused, 1U);
  EXPECT_EQ(report.digs.mass, 0);
  EXPECT_TRUE(report.carried.empty());
}

TEST_F(BotMovesTest, it_has_settled_no_sooner_than_its_walks_are_over) {
  start(walking());
  BotConfig bot = config(0, 0);
  bot.walks = 2;
  bot.linger = true;
  std::vector<std::pair<std::string, uint32_t>> said;
  Bot walker(bot, [&](const std::string& line) { said.emplace_back(line, 0); });
  ASSERT_TRUE(walker.join());
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!walker.finished() && std::chrono::steady_clock::now() < end) {
    ASSERT_TRUE(walker.step(std::chrono::milliseconds(5)));
    for (auto& [line, walks] : said)
      if (walks == 0) walks = 1 + walker.report().walks.done;
    if (walker.report().settled) {
      EXPECT_EQ(walker.report().walks.done, 2U);
    }
  }
  EXPECT_TRUE(walker.finished());
  EXPECT_TRUE(walker.report().settled);
  const auto settled = std::ranges::find_if(
      said, [](const auto& one) { return one.first.find("settled at tick") != std::string::npos; });
  ASSERT_NE(settled, said.end());
  EXPECT_EQ(settled->second, 3U) << "said after two walks";
}

}  // namespace
}  // namespace scree
