// What does not fit into a tick's budget: requests wait in order, fewer pieces break, and all of it is
// counted.
#include "server/work/work.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <map>

#include "bench/support/scenes.h"
#include "server/app/server_report.h"
#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/limits.h"
#include "server/world/merge_stage.h"
#include "server/world/spawn.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/rounds.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

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
  EXPECT_TRUE(delta->work.has_leftovers());
  uint32_t next = 0;
  int waited = 0;
  for (int tick = 0; tick < 300; ++tick) {
    for (const Reply& reply : delta->replies) EXPECT_EQ(reply.request, next++) << reply.refusal;
    if (next == 16) break;
    waited = delta->replies.empty() ? waited + 1 : 0;
    EXPECT_LE(static_cast<float>(waited), 60.0F * limits::request_rest_s)
        << "one is carried out now and then";
    delta = step(world);
  }
  EXPECT_EQ(next, 16U);
  EXPECT_EQ(delta->work.requests_waiting, 0U);
}

TEST(work, what_will_be_refused_does_not_wait_for_room) {
  World world({});
  step(world, {{1, 1, blows(world, 1, 64)[0].body}});
  CarveRequest many = blow_at(world.config().terrain, 8.0F, 0.0F, 2.0F, 4, 2);
  many.seeds = limits::seeds_max + 1;
  CarveRequest never = many;
  never.seeds = world.config().pieces_max + 1;
  CarveRequest fast = many;
  fast.seeds = 4;
  fast.blast_speed_m_s = 2.0F * limits::blast_speed_max_m_s;
  const auto delta = step(world, {{2, 1, many}, {2, 2, never}, {2, 3, fast}});
  ASSERT_EQ(delta->replies.size(), 3U) << "client 1 has pieces, so room is shared";
  for (const Reply& reply : delta->replies)
    EXPECT_EQ(reply.reason, reply.request == 2   ? Refusal::pieces_max
                            : reply.request == 3 ? Refusal::blast_speed
                                                 : Refusal::carve_invalid)
        << reply.refusal;
}

TEST(work, bodies_born_in_a_tick_count_in_that_tick) {
  World world({});
  const std::vector<Command> commands = blows(world, 1, 64);
  const float asked_us = price_us(commands[0].body, world.field(), Cutter::field);
  const auto delta = step(world, commands);
  ASSERT_EQ(delta->pieces.size(), 64U);
  const float bodies_us = 64.0F * limits::body_cost_us;
  EXPECT_GE(static_cast<float>(delta->work.estimate_us), asked_us + bodies_us - 1.0F);
  const auto next = step(world);
  EXPECT_GE(static_cast<float>(next->work.estimate_us), bodies_us - 1.0F) << "and in the next one alone";
  EXPECT_LT(next->work.estimate_us, delta->work.estimate_us);
}

TEST(work, a_tick_of_several_steps_counts_the_bodies_in_each) {
  const auto after_a_blow_us = [](uint32_t tick_rate_hz) {
    WorldConfig config;
    config.tick_rate_hz = tick_rate_hz;
    World world(config);
    step(world, blows(world, 1, 64));
    const auto delta = step(world);
    return static_cast<float>(delta->work.estimate_us) / static_cast<float>(delta->pieces.size());
  };
  EXPECT_GE(after_a_blow_us(60), limits::body_cost_us);
  EXPECT_GE(after_a_blow_us(10), 6.0F * limits::body_cost_us);
}

TEST(work, what_will_be_refused_is_answered_though_earlier_requests_are_still_to_be_paid_back) {
  World world({});
  CarveRequest large = blow_at(world.config().terrain, 0.0F, 0.0F, 8.0F, 800, 1);
  step(world, {{3, 1, large}});
  large.seeds = 0xFFFFFFFFU;
  const auto delta = step(world, {{3, 2, large}, {3, 3, FillRequest{sphere({0.0F, 5.0F, 0.0F}, 1e30F)}}});
  ASSERT_EQ(delta->replies.size(), 2U);
  for (const Reply& reply : delta->replies) EXPECT_NE(reply.refusal, "");
}

TEST(work, a_client_that_asks_for_more_than_a_second_of_work_is_told_so_at_once) {
  World world({});
  std::vector<Command> commands;
  for (uint32_t i = 0; i < 400; ++i) commands.push_back({3, i, blows(world, 1, 64)[0].body});
  const auto delta = step(world, commands);
  size_t refused = 0;
  for (const Reply& reply : delta->replies) {
    if (reply.reason != Refusal::requests_waiting) continue;
    ++refused;
    EXPECT_NE(reply.refusal.find("limits.waiting_work_max_s"), std::string::npos) << reply.refusal;
  }
  EXPECT_GT(refused, 100U);
  EXPECT_LT(refused, 399U);
}

TEST(work, where_ticks_have_less_time_less_work_may_wait) {
  const auto refused = [](uint32_t percent) {
    World world({});
    step(world, {{0, 0, SettingsRequest{{{"work-percent", std::to_string(percent)}}}}});
    std::vector<Command> commands;
    for (uint32_t i = 0; i < 400; ++i) commands.push_back({3, i, blows(world, 1, 64)[0].body});
    const auto delta = step(world, commands);
    return std::ranges::count(delta->replies, Refusal::requests_waiting, &Reply::reason);
  };
  EXPECT_GT(refused(limits::work_percent_max / 2), refused(limits::work_percent_max));
}

TEST(work, a_request_that_costs_several_ticks_is_paid_back_before_the_next) {
  World world({});
  CarveRequest large = blow_at(world.config().terrain, 0.0F, 0.0F, 8.0F, 250, 1);
  large.pattern = SeedPattern::even;  // all of its pieces are made at once
  large.blast_speed_m_s = 0.0F;
  auto delta = step(world, {{3, 1, large}, {3, 2, blow_at(world.config().terrain, 40.0F, 0.0F, 1.0F, 4, 1)}});
  ASSERT_EQ(delta->replies.size(), 1U);
  ASSERT_EQ(delta->replies[0].refusal, "");
  ASSERT_GT(delta->work.estimate_us, delta->work.budget_us);
  int ticks = 0;
  for (; delta->work.requests_waiting > 0 && ticks < 100; ++ticks) delta = step(world);
  EXPECT_GT(ticks, 1);
  EXPECT_LT(ticks, 100);
}

/// What became of the requests of a client.
struct Outcome {
  int asked = 0;
  int done = 0;
  uint32_t pieces = 0;
  Tick wait_max = 0;
};

/// One client asks twice a second for a blow of 2 m and 32 pieces, the others as often as they may; for that
/// many seconds. By session.
std::map<uint64_t, Outcome> crowd(uint64_t others, int seconds, float others_radius_m,
                                  uint32_t others_seeds) {
  World world({});
  std::map<uint64_t, Outcome> outcomes;
  std::map<std::pair<uint64_t, uint32_t>, Tick> asked;
  uint32_t number = 0;
  const auto ask = [&](std::vector<Command>& commands, uint64_t session, float radius_m, uint32_t seeds) {
    const float x_m = static_cast<float>(session) * 40.0F;
    const float z_m = static_cast<float>(number % 16) * 5.0F;
    commands.push_back(
        {session, ++number, blow_at(world.config().terrain, x_m, z_m, radius_m, seeds, number)});
    asked[{session, number}] = world.tick();
    ++outcomes[session].asked;
  };
  for (int tick = 0; tick < seconds * 60; ++tick) {
    std::vector<Command> commands;
    for (uint64_t other = 2; other < 2 + others; ++other)
      if (tick % 2 == 0) ask(commands, other, others_radius_m, others_seeds);
    if (tick % 30 == 15) ask(commands, 1, 2.0F, 32);
    const auto delta = world.step(commands);
    EXPECT_EQ(delta->ledger.error(), 0);
    for (const Reply& reply : delta->replies) {
      Outcome& outcome = outcomes[reply.session];
      outcome.wait_max = std::max(outcome.wait_max, delta->tick - asked.at({reply.session, reply.request}));
      if (!reply.refusal.empty()) continue;
      ++outcome.done;
      outcome.pieces += reply.pieces;
    }
  }
  return outcomes;
}

void expect_a_share_for_each(const std::map<uint64_t, Outcome>& outcomes) {
  const Outcome& honest = outcomes.at(1);
  EXPECT_GE(honest.done, honest.asked - 1);
  EXPECT_LE(honest.wait_max, 60U);
  EXPECT_GT(outcomes.at(2).done, 0) << "the others get their share as well";
  EXPECT_LT(outcomes.at(2).done, outcomes.at(2).asked);
}

constexpr int crowd_seconds = rounds(6, 4);

TEST(work, a_client_that_asks_for_much_does_not_keep_another_from_carving) {
  expect_a_share_for_each(crowd(1, crowd_seconds, 2.0F, 64));
}

TEST(work, a_carve_beside_many_others_gets_fewer_pieces_rather_than_none) {
  const auto outcomes = crowd(6, crowd_seconds, 2.0F, 64);
  expect_a_share_for_each(outcomes);
  EXPECT_LT(outcomes.at(1).pieces, static_cast<uint32_t>(outcomes.at(1).done) * 32U);
  EXPECT_GE(outcomes.at(1).pieces, static_cast<uint32_t>(outcomes.at(1).done));
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
  EXPECT_EQ(report.work.budget_us, static_cast<uint32_t>(0.01F * limits::work_percent_max * 1e6F / 60.0F));
  EXPECT_LE(report.work.first_cut_short, report.work.last_cut_short);
  EXPECT_NE(to_json(report).find("ticks_merging_sooner"), std::string::npos);
}

TEST(work, a_tick_has_the_percent_that_the_settings_say) {
  World world({});
  const auto budget_us = [](uint32_t percent) {
    return static_cast<uint32_t>(0.01F * static_cast<float>(percent) * 1e6F / 60.0F);
  };
  EXPECT_EQ(step(world, {})->work.budget_us, budget_us(limits::work_percent_max));
  const std::vector<Command> less{{0, 0, SettingsRequest{{{"work-percent", "30"}}}}};
  EXPECT_EQ(step(world, less)->work.budget_us, budget_us(30));
  const std::vector<Command> too_little{{0, 0, SettingsRequest{{{"work-percent", "14"}}}}};
  EXPECT_FALSE(step(world, too_little)->replies.front().refusal.empty());
  EXPECT_EQ(step(world, {})->work.budget_us, budget_us(30));
}

TEST(work, a_tick_without_any_budget_left_still_merges_a_few) {
  WorldConfig config = flat_world();
  config.tick_rate_hz = 30;
  World::State state(config, 1);
  TickDelta delta;
  const glm::vec3 centre_m(0.0F, 0.0F, 0.0F);
  const Applied cut = state.apply_and_record(
      CarveOperation{sphere(centre_m, 2.0F), SeedPattern::uniform, 128, 1, centre_m, 1}, 0, delta);
  const auto where_it_was = [](PieceId, const Volume& volume) {
    Newborn born;
    born.body.pose.position_m = volume.centre_voxels * voxel_m;
    return born;
  };
  spawn(state, cut, where_it_was, delta);
  const auto most = static_cast<size_t>(limits::merge_least_us / least_merge_cost_us(state));
  for (int tick = 0; tick < 300 && state.at_rest.size() <= most; ++tick) {
    state.bodies.step();
    settle(state, delta);
  }
  ASSERT_GT(state.at_rest.size(), most);
  const size_t could_merge = state.at_rest.size() + delta.work.merges_put_off;
  state.work.spend(1e6F);
  settle(state, delta);
  float sum_us = 0.0F;
  for (const PieceId id : state.at_rest) sum_us += merge_cost_us(state, id);
  EXPECT_LE(sum_us, limits::merge_least_us);
  EXPECT_GT(sum_us, 0.5F * limits::merge_least_us);
  EXPECT_GE(delta.work.merges_put_off, could_merge - state.at_rest.size()) << "more have come to rest";
}

TEST(work, without_merging_what_rests_is_frozen_and_thaws_for_the_next_blow) {
  WorldConfig config;
  config.methods.recombine = Recombination::off;
  World world(config);
  auto delta = step(world, blows(world, 1, 32));
  const size_t made = delta->pieces.size();
  for (int tick = 0; tick < 900; ++tick) delta = step(world);
  EXPECT_GE(delta->pieces.size(), made);
  EXPECT_LE(static_cast<float>(delta->work.estimate_us),
            limits::piece_cost_us * static_cast<float>(delta->pieces.size()))
      << "nothing is awake";
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

TEST(work, what_waits_for_a_session_that_leaves_is_dropped_and_refused_by_name) {
  World world({});
  std::vector<Command> asked = blows(world, 4, 64);
  for (Command& command : asked) command.session = command.request % 2 == 0 ? 3 : 4;
  const auto first = step(world, asked);
  const auto waiting = first->work.requests_waiting;
  ASSERT_GT(waiting, 2U);
  auto delta = step(world, {{3, 0, LeaveRequest{}}});
  uint32_t dropped = 0;
  for (const Reply& reply : delta->replies) {
    if (reply.reason != Refusal::session_over) continue;
    ++dropped;
    EXPECT_EQ(reply.session, 3U);
  }
  EXPECT_GT(dropped, 0U);
  for (int tick = 0; tick < 300 && delta->work.requests_waiting > 0; ++tick) {
    delta = step(world);
    for (const Reply& reply : delta->replies) {
      EXPECT_EQ(reply.session, 4U);
      EXPECT_EQ(reply.refusal, "");
    }
  }
  EXPECT_EQ(delta->work.requests_waiting, 0U);
}

}  // namespace
}  // namespace scree
