// What does not fit into a tick's budget: requests wait in order, fewer pieces break, and all of it is
// counted.
#include "server/world/work.h"

#include <gtest/gtest.h>
#include <limits>

#include "bench/support/scenes.h"
#include "server/app/server_report.h"
#include "server/world/limits.h"
#include "server/world/merge_stage.h"
#include "server/world/spawn.h"
#include "server/world/world.h"

namespace scree {
namespace {

std::shared_ptr<const TickDelta> step(World& world, const std::vector<Command>& commands = {}) {
  return world.step(commands);
}

/// That many blows side by side, as if asked for at once.
std::vector<Command> blows(const World& world, uint32_t a_side, uint32_t seeds) {
  BlowGrid grid(world.config().terrain, a_side, 5.0F, 2.0F, seeds);
  std::vector<Command> commands;
  while (const auto blow = grid.next())
    commands.push_back({3, static_cast<uint32_t>(commands.size()), *blow});
  return commands;
}

TEST(work, requests_over_the_budget_wait_and_are_carried_out_in_order) {
  World world({});
  auto delta = step(world, blows(world, 4, 64));
  EXPECT_GT(delta->work.requests_waiting, 0U);
  EXPECT_EQ(delta->replies.size() + delta->work.requests_waiting, 16U);
  EXPECT_TRUE(delta->work.cut_short());
  uint32_t next = 0;
  for (int tick = 0; tick < 16; ++tick) {
    for (const Reply& reply : delta->replies) EXPECT_EQ(reply.request, next++) << reply.refusal;
    if (next == 16) break;
    delta = step(world);
    EXPECT_GE(delta->replies.size(), 1U) << "every tick carries out one, whatever it costs";
  }
  EXPECT_EQ(next, 16U);
  EXPECT_EQ(delta->work.requests_waiting, 0U);
}

TEST(work, what_will_be_refused_takes_nothing_from_the_others) {
  const auto filling = [](glm::vec3 at_m, float radius_m) {
    return cost_us(Command{1, 1, FillRequest{sphere(at_m, radius_m)}}, 0.25F);
  };
  EXPECT_GT(filling({0.0F, 5.0F, 0.0F}, 2.0F), 0.0F);
  EXPECT_EQ(filling({1e30F, 5.0F, 0.0F}, 2.0F), 0.0F);
  EXPECT_EQ(filling({0.0F, 5.0F, 0.0F}, 1e30F), 0.0F);
  EXPECT_EQ(filling({0.0F, std::numeric_limits<float>::quiet_NaN(), 0.0F}, 2.0F), 0.0F);
}

TEST(work, bodies_born_in_a_tick_count_in_that_tick) {
  World world({});
  const std::vector<Command> commands = blows(world, 1, 64);
  const float asked_us = cost_us(commands[0], world.config().terrain.voxel_size_m);
  const auto delta = step(world, commands);
  ASSERT_EQ(delta->pieces.size(), 64U);
  const float bodies_us = 64.0F * limits::body_cost_us;
  EXPECT_GE(static_cast<float>(delta->work.estimate_us), asked_us + bodies_us - 1.0F);
  const auto next = step(world);
  EXPECT_GE(static_cast<float>(next->work.estimate_us), bodies_us - 1.0F) << "and in the next one alone";
  EXPECT_LT(next->work.estimate_us, delta->work.estimate_us);
}

TEST(work, too_many_requests_at_once_are_refused_by_name) {
  World world({});
  std::vector<Command> commands;
  for (uint32_t i = 0; i < limits::requests_waiting_max + 3; ++i) commands.push_back(blows(world, 1, 8)[0]);
  const auto delta = step(world, commands);
  ASSERT_GE(delta->replies.size(), 3U);
  for (size_t i = 0; i < 3; ++i)
    EXPECT_NE(delta->replies[i].refusal.find("limits.requests_waiting_max"), std::string::npos);
}

TEST(work, what_is_cut_is_the_same_every_time_and_reported) {
  World one({}), two({});
  ServerReport report;
  bool sooner = false;
  for (int tick = 0; tick < 60; ++tick) {
    const std::vector<Command> commands = tick == 0 ? blows(one, 5, 64) : std::vector<Command>{};
    const auto a = step(one, commands), b = step(two, commands);
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
    EXPECT_EQ(a->work.estimate_us, b->work.estimate_us);
    EXPECT_EQ(a->ledger.error(), 0);
    sooner = sooner || a->work.merging_sooner;
    report.add(*a);
  }
  EXPECT_TRUE(sooner) << "a crowd merges sooner";
  EXPECT_GT(report.work.ticks_cut_short, 0U);
  EXPECT_EQ(report.work.budget_us, 12500U);
  EXPECT_LE(report.work.first_cut_short, report.work.last_cut_short);
  EXPECT_NE(to_json(report).find("ticks_merging_sooner"), std::string::npos);
}

TEST(work, a_tick_without_any_budget_left_still_merges_a_few) {
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, 0.25F};
  World::State state(config);
  TickDelta delta;
  const glm::vec3 centre_m(0.0F, 0.0F, 0.0F);
  const Applied cut = state.apply_and_record(
      CarveOperation{sphere(centre_m, 1.0F), SeedPattern::uniform, 12, 1, centre_m, 1}, delta);
  const auto where_it_was = [](PieceId, const Volume& volume) {
    Newborn born;
    born.body.pose.position_m = volume.centre_voxels * 0.25F;
    return born;
  };
  spawn(state, cut, where_it_was, delta);
  for (int tick = 0; tick < 300 && state.at_rest.size() <= limits::merges_per_tick_min; ++tick) {
    state.bodies.step();
    settle(state, delta);
  }
  ASSERT_GT(state.at_rest.size(), limits::merges_per_tick_min);
  const size_t could_merge = state.at_rest.size() + delta.work.merges_put_off;
  state.work.spend(1e6F);
  settle(state, delta);
  EXPECT_EQ(state.at_rest.size(), limits::merges_per_tick_min);
  EXPECT_EQ(delta.work.merges_put_off, could_merge - limits::merges_per_tick_min);
}

TEST(work, without_merging_what_rests_is_frozen_and_thaws_for_the_next_blow) {
  WorldConfig config;
  config.methods.recombine = Recombination::off;
  World world(config);
  auto delta = step(world, blows(world, 1, 32));
  const size_t made = delta->pieces.size();
  for (int tick = 0; tick < 900; ++tick) delta = step(world);
  EXPECT_GE(delta->pieces.size(), made);
  EXPECT_EQ(delta->work.estimate_us, 0U) << "nothing is awake";
  const auto settled = delta->pieces;
  step(world, {{1, 1, blow_at(config.terrain, 2.0F, 0.0F, 2.0F, 8, 1)}});
  for (int tick = 0; tick < 60; ++tick) delta = step(world);
  size_t moved = 0;
  for (size_t i = 0; i < settled.size(); ++i)
    moved += i < delta->pieces.size() && !(delta->pieces[i].pose == settled[i].pose) ? 1 : 0;
  EXPECT_GT(moved, 0U);
  EXPECT_EQ(delta->ledger.error(), 0);
  step(world, {{1, 2, SettingsRequest{{{"recombine", "stamp"}}}}});
  for (int tick = 0; tick < 900 && !delta->pieces.empty(); ++tick) delta = step(world);
  EXPECT_TRUE(delta->pieces.empty()) << "what was frozen merges when that is switched on again";
}

}  // namespace
}  // namespace scree
