// A world as a value: what goes on from it goes the same way every time, and the value crosses bytes as it
// is.
#include <gtest/gtest.h>

#include "bench/support/scenes.h"
#include "server/formats/world_codec.h"
#include "server/world/world.h"
#include "server/world/world_snapshot.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

/// A storm of three parties: blows now and then, some too large to be cut at once.
std::vector<Command> storm_commands(const World& world, Tick tick) {
  if (tick % 6 != 0 || tick > 60) return {};
  const uint64_t session = 1 + tick / 6 % 3;
  const auto number = static_cast<uint32_t>(tick);
  const float x = -6.0F + static_cast<float>(tick * 5 % 12);
  return {{session, number,
           blow_at(world.config().terrain, x, static_cast<float>(session) * 2.0F - 4.0F, 1.5F,
                   session == 2 ? 100 : 16, number),
           session}};
}

struct Storm {
  TerrainColliderKind collider = TerrainColliderKind::field;
  Recombination recombine = Recombination::stamp;
  bool support = false;
};

std::unique_ptr<World> raging_world(const Storm& storm, Tick ticks) {
  WorldConfig config;
  config.methods.collider = storm.collider;
  config.methods.recombine = storm.recombine;
  config.methods.support = storm.support;
  auto world = std::make_unique<World>(config);
  for (Tick tick = 1; tick <= ticks; ++tick) step(*world, storm_commands(*world, tick));
  return world;
}

/// Long enough for pieces to fall, break and merge.
constexpr Tick ticks_compared = 120;

std::unique_ptr<World> restored(const WorldSnapshot& value) {
  auto world = World::restore(value);
  EXPECT_TRUE(world.has_value()) << world.error().message;
  return world ? std::move(*world) : nullptr;
}

class SnapshotOfStorm : public testing::TestWithParam<Storm> {};

TEST_P(SnapshotOfStorm, goes_on_the_same_way_every_time) {
  const auto world = raging_world(GetParam(), 50);
  const WorldSnapshot value = world->snapshot();
  EXPECT_GT(value.moment.pieces.size(), 20U);
  const auto decoded = decode_world(encode(value));
  ASSERT_TRUE(decoded.has_value()) << decoded.error().message;
  const auto one = restored(value), other = restored(*decoded);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(encode(one->snapshot()), encode(value));
  for (Tick tick = 51; tick <= 51 + ticks_compared; ++tick) {
    const auto a = step(*one, storm_commands(*one, tick)), b = step(*other, storm_commands(*other, tick));
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
    ASSERT_EQ(a->ledger.error(), 0);
  }
  EXPECT_EQ(one->measure_terrain(), one->moment().ledger.terrain);
}

INSTANTIATE_TEST_SUITE_P(merges, SnapshotOfStorm,
                         testing::Values(Storm{TerrainColliderKind::field, Recombination::stamp, true},
                                         Storm{TerrainColliderKind::mesh, Recombination::slices, false},
                                         Storm{TerrainColliderKind::rays, Recombination::sphere, false},
                                         Storm{TerrainColliderKind::field, Recombination::off, false}),
                         [](const auto& storm) { return std::string(row_of(storm.param.recombine).name); });

TEST(snapshot, requests_and_cuts_that_wait_are_answered_by_the_restored_world) {
  World world({});
  std::vector<Command> commands;
  for (uint32_t request = 1; request <= 4; ++request) {
    const float x = static_cast<float>(request) * 3.0F - 15.0F;
    commands.push_back({1, request, blow_at(world.config().terrain, x, 0.0F, 2.0F, 600, request)});
  }
  const size_t at_once = step(world, commands)->replies.size();
  const WorldSnapshot value = world.snapshot();
  size_t waiting = 0;
  for (const PartyValue& party : value.moment.requests.parties)
    for (const SessionValue& session : party.sessions) waiting += session.requests.size();
  EXPECT_GT(waiting, 0U);
  EXPECT_EQ(at_once + waiting, commands.size());
  EXPECT_FALSE(value.moment.refractures.empty());
  const auto other = restored(value);
  ASSERT_TRUE(other);
  size_t answered = 0;
  for (int tick = 0; tick < 200 && answered < waiting; ++tick) answered += step(*other)->replies.size();
  EXPECT_EQ(answered, waiting);
  EXPECT_EQ(first_free_session(value.moment), 2U);
}

TEST(snapshot, a_restored_world_settles_as_the_running_one_does) {
  const auto world = raging_world({}, 60);
  const auto other = restored(world->snapshot());
  ASSERT_TRUE(other);
  size_t ticks = 0;
  for (; ticks < 1800 && !step(*other)->pieces.empty(); ++ticks) {
  }
  EXPECT_LT(ticks, 1800U);
  EXPECT_EQ(other->moment().ledger.pieces, 0);
}

TEST(snapshot, a_value_whose_parts_do_not_agree_is_refused_by_name) {
  const WorldSnapshot good = raging_world({}, 30)->snapshot();
  const auto refusal = [&](auto&& spoil) {
    WorldSnapshot bad = good;
    spoil(bad);
    const auto world = World::restore(bad);
    return world ? std::string("none") : world.error().message;
  };
  const auto expect = [&](const char* word, auto&& spoil) {
    const std::string said = refusal(spoil);
    EXPECT_NE(said.find(word), std::string::npos) << said;
  };
  expect("terrain is not", [](WorldSnapshot& w) { w.bricks.pop_back(); });
  expect("not in order", [](WorldSnapshot& w) { std::swap(w.bricks[0], w.bricks[1]); });
  expect("mass of its pieces", [](WorldSnapshot& w) { w.moment.ledger.pieces += 1; });
  expect("mass of its terrain", [](WorldSnapshot& w) { w.moment.ledger.terrain += 1; });
  expect("balance", [](WorldSnapshot& w) { w.moment.ledger.dust += 1; });
  expect("more than there can be", [](WorldSnapshot& w) {
    w.moment.ledger.dust += int64_t{1} << 61U;
    w.moment.ledger.poured += int64_t{1} << 61U;
  });
  expect("less than nothing", [](WorldSnapshot& w) { w.moment.ledger.moved = -1; });
  expect("hash", [](WorldSnapshot& w) { w.moment.motion.bodies[0].velocity_m_s.x += 0.01F; });
  expect("rotation", [](WorldSnapshot& w) { w.moment.motion.bodies[0].basis[0] *= 2.0F; });
  expect("faster", [](WorldSnapshot& w) { w.moment.motion.bodies[0].velocity_m_s.x = 1e20F; });
  expect("outside the world", [](WorldSnapshot& w) { w.moment.motion.bodies[0].origin_m.x = 1e9F; });
  expect("bodies", [](WorldSnapshot& w) { w.moment.motion.bodies.pop_back(); });
  expect("beyond its voxels", [](WorldSnapshot& w) {
    BodyShape shape = *w.moment.pieces[0].shape;
    shape.hull_m[0].x = 1e6F;
    w.moment.pieces[0].shape = std::make_shared<const BodyShape>(shape);
  });
  expect("mass is none", [](WorldSnapshot& w) {
    BodyShape shape = *w.moment.pieces[0].shape;
    shape.mass_kg = 1e30F;
    w.moment.pieces[0].shape = std::make_shared<const BodyShape>(shape);
  });
  expect("authored", [](WorldSnapshot& w) {
    w.moment.refractures.push_back({w.moment.pieces[0].id, 2, SeedPattern::authored, 1, {}, nullptr});
  });
  expect("ids are used up", [](WorldSnapshot& w) { w.moment.next_piece = UINT32_MAX; });
  expect("after its tick", [](WorldSnapshot& w) { w.moment.requested = 31; });
  expect("has no body", [](WorldSnapshot& w) { w.moment.next_piece = 1; });
  expect("tick_rate_hz", [](WorldSnapshot& w) { w.moment.config.tick_rate_hz = 1; });
}

TEST(snapshot, bytes_that_end_early_are_refused) {
  const std::vector<uint8_t> bytes = encode(raging_world({}, 16)->snapshot().moment);
  for (size_t length = 0; length < bytes.size(); length += 1 + length / 16) {
    const auto moment = decode_world_moment(std::span(bytes).first(length));
    if (!moment) continue;
    EXPECT_NE(encode(*moment), bytes) << length;  // a shorter message may be one, but is another
  }
}

}  // namespace
}  // namespace scree
