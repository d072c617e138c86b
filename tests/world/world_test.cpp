// The simulation, tick by tick: mass, refusals, determinism.
#include "server/world/world.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "bench/support/scenes.h"
#include "server/world/published_state.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

Command blow(const World& world, float x_m, float z_m, uint32_t seeds, uint32_t request = 1) {
  return {7, request, blow_at(world.config().terrain, x_m, z_m, 1.5F, seeds, 3)};
}

TEST(world, carve_fall_and_merge_conserve_mass_at_every_tick) {
  World world({});
  PublishedState published;
  auto delta = step(world, {blow(world, 12.0F, 12.0F, 24)});
  ASSERT_EQ(delta->spawned.size(), 24U);
  EXPECT_GT(delta->ledger.moved, 0);
  for (int tick = 0; tick < settle_ticks_max && !delta->pieces.empty(); ++tick) {
    EXPECT_EQ(delta->ledger.error(), 0);
    published.apply(*delta);
    delta = step(world);
  }
  published.apply(*delta);
  EXPECT_TRUE(delta->pieces.empty()) << "pieces still alive";
  EXPECT_EQ(world.measure_terrain(), delta->ledger.terrain);
  EXPECT_EQ(delta->ledger.terrain + delta->ledger.dust, 0);
  EXPECT_EQ(published.pieces_merged(), 24U);
  EXPECT_LT(std::abs(static_cast<double>(delta->ledger.dust)),
            0.05 * static_cast<double>(delta->ledger.moved));
}

TEST(world, what_is_published_is_what_is_there) {
  World world({});
  PublishedState published;
  for (int tick = 0; tick < 90; ++tick) {
    std::vector<Command> commands;
    if (tick % 30 == 0) commands.push_back(blow(world, 10.0F + static_cast<float>(tick) * 0.02F, 9.0F, 12));
    published.apply(*step(world, commands));
  }
  uint64_t sum = 0;
  for (const auto& [coord, chunk] : published.chunks()) sum += chunk.hash;
  EXPECT_EQ(sum, world.field().hash());
  EXPECT_EQ(published.field_hash(), world.field().hash());
  for (const auto& [coord, chunk] : published.chunks())
    EXPECT_EQ(published.hash_at(coord, chunk.version), world.field().chunk_hash(coord));
  // A keyframe takes an empty state to the same place.
  PublishedState resumed;
  resumed.apply(published.as_delta());
  EXPECT_EQ(resumed.tick(), published.tick());
  EXPECT_EQ(resumed.pieces().size(), published.pieces().size());
  EXPECT_EQ(resumed.chunks().size(), published.chunks().size());
}

TEST(world, two_worlds_with_the_same_commands_agree_at_every_tick) {
  World one({}), other({});
  for (int tick = 0; tick < 300; ++tick) {
    std::vector<Command> commands;
    if (tick % 100 == 0) commands.push_back(blow(one, 8.0F, static_cast<float>(tick) * 0.05F, 16));
    const auto a = step(one, commands), b = step(other, commands);
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
    ASSERT_EQ(a->field_hash, b->field_hash) << "tick " << tick;
  }
}

TEST(world, every_cutter_with_every_simplifier_conserves_mass_and_merges) {
  for (const Cutter cutter : {Cutter::field, Cutter::slice, Cutter::conform})
    for (const Simplifier simplifier : {Simplifier::none, Simplifier::hull, Simplifier::merge}) {
      SCOPED_TRACE(static_cast<int>(cutter) * 10 + static_cast<int>(simplifier));
      WorldConfig config;
      config.methods.cutter = cutter;
      config.methods.simplifier = simplifier;
      config.methods.dents = false;  // of which more pieces come
      World one(config), other(config);
      Command command = blow(one, 12.0F, 12.0F, 16);
      size_t merges = 0;
      for (int tick = 0; tick < 400; ++tick) {
        const std::vector<Command> commands =
            tick == 0 ? std::vector<Command>{command} : std::vector<Command>{};
        const auto delta = step(one, commands);
        ASSERT_EQ(delta->ledger.error(), 0);
        ASSERT_EQ(step(other, commands)->state_hash, delta->state_hash);
        EXPECT_EQ(delta->spawned.size(), tick == 0 ? 16U : 0U);
        for (const AppliedOperation& applied : delta->operations)
          merges += std::holds_alternative<StampOperation>(applied.operation) ? 1 : 0;
      }
      EXPECT_GT(merges, 8U);
    }
}

TEST(world, requests_that_cannot_be_carried_out_are_answered_by_name_and_change_nothing) {
  World world({});
  const auto refused = [&](const CarveRequest& request, const char* word) {
    const auto delta = step(world, {{7, 42, request}});
    ASSERT_EQ(delta->replies.size(), 1U);
    EXPECT_EQ(delta->replies[0].session, 7U);
    EXPECT_EQ(delta->replies[0].request, 42U);
    EXPECT_NE(delta->replies[0].refusal.find(word), std::string::npos) << delta->replies[0].refusal;
    EXPECT_TRUE(delta->bricks.empty());
    EXPECT_EQ(delta->field_hash, 0U);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const CarveRequest good = blow_at(world.config().terrain, 12.0F, 0.0F, 1.5F, 8, 1);
  for (const auto& [radius, word] :
       {std::pair{nan, "not a finite"}, std::pair{infinite, "not a finite"}, std::pair{-2.0F, "negative"},
        std::pair{0.0F, "zero"}, std::pair{100.0F, "may be at most 8 m"},
        std::pair{1e-3F, "must be at least 0.125 m"}}) {
    CarveRequest bad = good;
    bad.shape.radius_m = radius;
    refused(bad, word);
  }
  CarveRequest far = good;
  far.shape.a.x = 1e7F;
  refused(far, "outside the world");
  CarveRequest fast = good;
  fast.blast_speed_m_s = nan;
  refused(fast, "from 0 to 30 m/s");
  CarveRequest many = good;
  many.seeds = 100000;
  refused(many, "seeds are over the limit");
}

TEST(world, carves_beyond_the_most_pieces_are_refused_until_some_have_settled) {
  WorldConfig config;
  config.pieces_max = 20;
  World world(config);
  EXPECT_TRUE(step(world, {blow(world, 12.0F, 12.0F, 16)})->replies[0].refusal.empty());
  const auto delta = step(world, {blow(world, 20.0F, 12.0F, 16)});
  EXPECT_NE(delta->replies[0].refusal.find("pieces-max"), std::string::npos) << delta->replies[0].refusal;
  EXPECT_EQ(delta->ledger.error(), 0);
}

TEST(world, a_fill_is_entered_as_poured) {
  WorldConfig config;
  config.methods.islands = false;  // it hangs in the air
  World world(config);
  const auto delta = step(world, {{1, 1, FillRequest{box({30.0F, 25.0F, 0.0F}, {1.0F, 1.0F, 1.0F})}}});
  EXPECT_TRUE(delta->replies[0].refusal.empty()) << delta->replies[0].refusal;
  EXPECT_NEAR(static_cast<double>(delta->ledger.poured) / units_per_voxel, 512.0, 30.0);
  EXPECT_EQ(delta->ledger.terrain, delta->ledger.poured);
  EXPECT_EQ(delta->ledger.error(), 0);
}

TEST(world, poured_rock_that_rests_on_nothing_falls_and_becomes_ground) {
  World world({});
  auto delta = step(world, {{1, 1, FillRequest{box({30.0F, 25.0F, 0.0F}, {1.0F, 1.0F, 1.0F})}}});
  ASSERT_EQ(delta->pieces.size(), 1U);
  EXPECT_EQ(delta->ledger.terrain, 0);
  EXPECT_EQ(delta->ledger.pieces, delta->ledger.poured);
  for (int tick = 0; tick < 1200 && !delta->pieces.empty(); ++tick) delta = step(world);
  EXPECT_TRUE(delta->pieces.empty());
  EXPECT_EQ(delta->ledger.terrain + delta->ledger.dust, delta->ledger.poured);
}

TEST(world, poured_rock_that_is_held_stays) {
  World world({});
  const float ground_m = ground_height_m(world.config().terrain, 30.0F, 0.0F);
  const auto delta = step(world, {{1, 1, FillRequest{box({30.0F, ground_m, 0.0F}, {1.0F, 4.0F, 1.0F})}}});
  EXPECT_TRUE(delta->pieces.empty());
  EXPECT_EQ(delta->ledger.terrain, delta->ledger.poured);
}

}  // namespace
}  // namespace scree
