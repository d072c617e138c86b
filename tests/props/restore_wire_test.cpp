// Clients get what was taken back, as an operation or as bricks.
#include "tests/support/flat_world.h"
#include "tests/support/prop_follower.h"

namespace scree {
namespace {

/// Takes back what a tick did to the chunk of the first brick that it changed.
RestoreRequest undo_of(const TickDelta& delta) {
  auto bricks = std::make_shared<std::vector<RestoreRequest::Brick>>();
  for (const BrickState& now : delta.bricks) {
    if (chunk_of(now.coord) != chunk_of(delta.bricks.front().coord)) continue;
    for (const ReplacedBrick& replaced : delta.replaced)
      if (replaced.was.coord == now.coord) bricks->push_back({replaced.was, now.hash});
  }
  return {.bricks = std::move(bricks)};
}

TEST(RestoreWire, every_client_has_the_terrain_whatever_operations_it_knows) {
  for (const uint32_t operations : {operation_kinds, operation_kinds - 1, 0U}) {
    World world(rock_world());
    world.want_replaced(true);
    Follower follower(world, {0.0F, 2.0F, 0.0F});
    follower.publisher().leave(Follower::session);
    follower.publisher().join(Follower::session, {0.0F, 2.0F, 0.0F}, 32.0F, operations);
    const auto step = [&](const std::vector<Command>& commands) {
      const auto delta = world.step(commands);
      follower.follow(*delta);
      return delta;
    };
    const auto filled = step({{2, 1, FillRequest{sphere({1.0F, 1.0F, 1.0F}, 2.0F)}}});
    ASSERT_FALSE(filled->bricks.empty());
    const auto restored = step({{0, 1, undo_of(*filled)}});
    ASSERT_FALSE(restored->bricks.empty());
    for (int i = 0; i < 60; ++i) step({});
    EXPECT_EQ(follower.mirror().field().hash(), restored->field_hash) << operations;
    EXPECT_EQ(follower.mirror().mismatches(), 0U);
    EXPECT_EQ(follower.mirror().counters().operations.of<RestoreOperation>(),
              operations == operation_kinds ? 1U : 0U);
  }
}

}  // namespace
}  // namespace scree
