// Terrain that is cut off falls: towers and arches in a whole world.
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>
#include <unistd.h>

#include "client/mirror/mirror.h"
#include "server/field/vdb_field.h"
#include "server/store/recorder.h"
#include "server/world/island_stage.h"
#include "server/world/limits.h"
#include "server/world/published_state.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/verify_recording.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

std::vector<Command> pour_all(const std::vector<Shape>& shapes) {
  std::vector<Command> commands;
  for (const Shape& shape : shapes) commands.push_back({1, 1, FillRequest{shape}});
  return commands;
}

/// One piece from the cut itself; it stays where it is.
Command undercut(const Shape& shape) {
  CarveRequest request;
  request.shape = shape;
  request.seeds = 1;
  request.impact_m = centre_of(shape);
  request.blast_speed_m_s = 0.0F;
  return {1, 2, request};
}

size_t islands_of(const TickDelta& delta) {
  return static_cast<size_t>(std::ranges::count_if(delta.operations, [](const AppliedOperation& applied) {
    return std::holds_alternative<IslandOperation>(applied.operation);
  }));
}

MassUnits mass_of(const TickDelta& delta, size_t spawned) {
  return delta.spawned.at(spawned).volume->mass;
}

TEST(falling, a_tower_cut_at_its_foot_falls_in_the_tick_of_the_cut) {
  World world(flat_world());
  const auto poured = step(world, pour_all({box({0.0F, 4.0F, 0.0F}, {1.5F, 6.0F, 1.5F})}));
  const auto delta = step(world, {undercut(box({0.0F, 0.75F, 0.0F}, {2.0F, 0.5F, 2.0F}))});
  EXPECT_TRUE(delta->replies[0].refusal.empty()) << delta->replies[0].refusal;
  ASSERT_EQ(islands_of(*delta), 1U);
  ASSERT_EQ(delta->spawned.size(), 2U);
  // 3 × 3 m, from 1.25 to 10 m, in voxels.
  EXPECT_NEAR(static_cast<double>(mass_of(*delta, 1)) / units_per_voxel, 12.0 * 12.0 * 35.0, 60.0);
  EXPECT_EQ(delta->ledger.error(), 0);
  EXPECT_EQ(world.measure_terrain(), delta->ledger.terrain);
  EXPECT_EQ(delta->ledger.poured, poured->ledger.poured);
}

TEST(falling, what_fell_comes_to_rest_and_is_terrain_again) {
  World world(flat_world());
  step(world, pour_all({box({0.0F, 2.0F, 0.0F}, {1.0F, 3.0F, 1.0F})}));
  PublishedState published;
  auto delta = step(world, {undercut(box({0.0F, 0.75F, 0.0F}, {1.5F, 0.5F, 1.5F}))});
  ASSERT_EQ(islands_of(*delta), 1U);
  const MassUnits fell = mass_of(*delta, 1);
  for (int tick = 0; tick < settle_ticks_max && !delta->pieces.empty(); ++tick) {
    ASSERT_EQ(delta->ledger.error(), 0);
    delta = step(world);
  }
  EXPECT_TRUE(delta->pieces.empty());
  EXPECT_EQ(world.measure_terrain(), delta->ledger.terrain);
  EXPECT_LT(std::abs(static_cast<double>(delta->ledger.dust)), 0.02 * static_cast<double>(fell));
}

TEST(falling, an_arch_cut_at_one_end_hangs_and_at_both_ends_falls) {
  World world(flat_world());
  step(world,
       pour_all({box({-5.0F, 3.0F, 0.0F}, {1.0F, 4.0F, 1.0F}), box({5.0F, 3.0F, 0.0F}, {1.0F, 4.0F, 1.0F}),
                 box({0.0F, 6.5F, 0.0F}, {6.0F, 1.0F, 1.0F})}));
  const auto one = step(world, {undercut(sphere({-5.0F, 2.0F, 0.0F}, 2.0F))});
  EXPECT_EQ(islands_of(*one), 0U);
  const auto both = step(world, {undercut(sphere({5.0F, 2.0F, 0.0F}, 2.0F))});
  ASSERT_EQ(islands_of(*both), 1U);
  EXPECT_GT(mass_of(*both, both->spawned.size() - 1), MassUnits{units_per_voxel} * 48 * 8 * 8);
  EXPECT_EQ(both->ledger.error(), 0);
  EXPECT_EQ(world.measure_terrain(), both->ledger.terrain);
}

/// A viaduct of 44 m on three legs.
std::vector<Command> viaduct() {
  std::vector<Shape> shapes;
  for (const float x : {-16.0F, 0.0F, 16.0F}) shapes.push_back(box({x, 3.0F, 0.0F}, {1.0F, 4.0F, 1.0F}));
  for (const float x : {-16.5F, -5.5F, 5.5F, 16.5F})
    shapes.push_back(box({x, 7.5F, 0.0F}, {5.75F, 1.0F, 2.0F}));
  return pour_all(shapes);
}

TEST(falling, a_viaduct_longer_than_a_piece_may_be_falls_in_several) {
  World world(flat_world());
  step(world, viaduct());
  auto delta =
      step(world, {undercut(sphere({-16.0F, 2.0F, 0.0F}, 2.0F)), undercut(sphere({0.0F, 2.0F, 0.0F}, 2.0F)),
                   undercut(sphere({16.0F, 2.0F, 0.0F}, 2.0F))});
  size_t islands = 0;
  MassUnits fell = 0;
  for (int tick = 0; tick < 60; ++tick) {
    const size_t here = islands_of(*delta);
    for (size_t i = delta->spawned.size() - here; i < delta->spawned.size(); ++i) fell += mass_of(*delta, i);
    islands += here;
    ASSERT_EQ(delta->ledger.error(), 0);
    ASSERT_EQ(world.measure_terrain(), delta->ledger.terrain);
    delta = step(world);
  }
  EXPECT_GE(islands, 2U);
  EXPECT_GT(fell, MassUnits{units_per_voxel} * 44 * 4 * 8 * 16 * 95 / 100);
  EXPECT_EQ(delta->work.islands_put_off, 0U);
  EXPECT_EQ(delta->work.islands_too_large, 0U);
}

TEST(falling, blocks_over_the_budget_wait_and_fall_in_later_ticks) {
  WorldConfig config = flat_world();
  config.tick_rate_hz = 1000;  // a budget of 0.75 ms
  World world(config);
  for (int i = 0; i < 60; ++i) step(world, i == 0 ? viaduct() : std::vector<Command>{});
  std::vector<Command> cuts = {undercut(sphere({-16.0F, 2.0F, 0.0F}, 2.0F)),
                               undercut(sphere({0.0F, 2.0F, 0.0F}, 2.0F)),
                               undercut(sphere({16.0F, 2.0F, 0.0F}, 2.0F))};
  size_t islands = 0, waited = 0;
  for (int tick = 0; tick < 800; ++tick) {
    const auto delta = step(world, std::exchange(cuts, {}));
    islands += islands_of(*delta);
    waited += delta->work.islands_put_off > 0 ? 1 : 0;
    EXPECT_LE(islands_of(*delta), 1U) << "no more in so short a tick";
    ASSERT_EQ(delta->ledger.error(), 0);
  }
  EXPECT_GE(islands, 2U);
  EXPECT_GE(waited, 1U);
}

TEST(falling, an_arch_falls_over_what_stands_beneath_it) {
  WorldConfig config = flat_world();
  config.methods.islands = false;  // or its parts fall before it is whole
  World world(config);
  // Its legs end half a metre above the ground; a block stands between them, higher than they reach down.
  auto delta = step(
      world,
      pour_all({box({-4.0F, 4.25F, 0.0F}, {1.0F, 3.75F, 1.0F}), box({4.0F, 4.25F, 0.0F}, {1.0F, 3.75F, 1.0F}),
                box({0.0F, 7.0F, 0.0F}, {5.0F, 1.0F, 1.0F}), box({0.0F, 1.5F, 0.0F}, {1.5F, 2.0F, 1.5F})}));
  while (delta->work.requests_waiting > 0) delta = step(world);
  delta = step(world, {{1, 9, SettingsRequest{{{"islands", "true"}}}}});
  ASSERT_EQ(islands_of(*delta), 1U);
  const PieceId arch = delta->spawned.back().id;
  const auto height_m = [&] {
    const auto at = std::ranges::find(delta->pieces, arch, &PieceState::id);
    return at == delta->pieces.end() ? 0.0F : dequantise(at->pose).position_m.y;
  };
  const float from_m = height_m();
  float lowest_m = from_m, highest_m = from_m;
  for (int tick = 0; tick < 120 && height_m() > 0.0F; ++tick) {
    lowest_m = std::min(lowest_m, height_m());
    highest_m = std::max(highest_m, height_m());
    delta = step(world);
  }
  EXPECT_LT(lowest_m, from_m - 0.35F);
  EXPECT_GT(lowest_m, from_m - 0.75F);
  EXPECT_LT(highest_m, from_m + 0.05F);
}

/// A beam on a post: what is cut out of it drops, and leaves the gap open.
auto cut_beam(World& world) {
  step(world, pour_all({box({0.0F, 4.0F, 0.0F}, {1.0F, 5.0F, 1.0F}),
                        box({4.0F, 7.0F, 0.0F}, {4.5F, 0.75F, 0.75F})}));
  return step(world, {undercut(box({2.0F, 7.0F, 0.0F}, {0.5F, 1.0F, 1.0F}))});
}

TEST(falling, an_island_waits_while_there_are_as_many_pieces_as_there_may_be) {
  WorldConfig config = flat_world();
  config.pieces_max = 1;
  World world(config);
  auto delta = cut_beam(world);
  EXPECT_EQ(delta->pieces.size(), 1U);
  EXPECT_EQ(islands_of(*delta), 0U);
  size_t islands = 0;
  for (int tick = 0; tick < settle_ticks_max && islands == 0; ++tick) {
    delta = step(world);
    EXPECT_LE(delta->pieces.size(), 1U);
    islands += islands_of(*delta);
  }
  EXPECT_EQ(islands, 1U);
  EXPECT_EQ(world.measure_terrain(), delta->ledger.terrain);
}

TEST(falling, of_islands_that_wait_the_lowest_falls_first) {
  VdbField field(flat_terrain);
  PieceTable pieces;
  std::set<BrickCoord> changed;
  for (const float y_m : {6.0F, 18.0F, 12.0F}) {
    const Applied poured = apply(FillOperation{box({0.0F, y_m, 0.0F}, glm::vec3(1.0F))}, field, pieces);
    changed.insert(poured.changed.begin(), poured.changed.end());
  }
  IslandQueue islands;
  islands.push(1, {changed.begin(), changed.end()});
  SearchAllowance allowance{.bricks = limits::island_bricks_per_tick_max};
  ASSERT_TRUE(islands.search(field, allowance));
  std::vector<int> feet;
  while (const Island* const next = islands.next()) {
    feet.push_back(next->box.lo.y);
    islands.pop(0.0F);
  }
  EXPECT_EQ(feet.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(feet));
}

TEST(falling, what_waits_to_fall_and_is_propped_up_meanwhile_stays) {
  WorldConfig config = flat_world();
  config.pieces_max = 1;
  World world(config);
  auto delta = cut_beam(world);
  ASSERT_EQ(delta->work.islands_put_off, 1U);
  EXPECT_TRUE(delta->work.has_leftovers());
  delta = step(world, pour_all({box({7.0F, 3.0F, 0.0F}, {0.5F, 4.0F, 0.5F})}));
  EXPECT_EQ(delta->work.islands_put_off, 0U);
  size_t islands = 0;
  for (int tick = 0; tick < settle_ticks_max && !delta->pieces.empty(); ++tick) {
    delta = step(world);
    islands += islands_of(*delta);
  }
  EXPECT_TRUE(delta->pieces.empty());
  EXPECT_EQ(islands, 0U);
}

TEST(falling, two_worlds_drop_the_same_islands_at_the_same_ticks) {
  World one(flat_world()), other(flat_world());
  size_t islands = 0;
  for (int tick = 0; tick < 200; ++tick) {
    std::vector<Command> commands;
    if (tick == 0)
      commands = pour_all(
          {box({0.0F, 4.0F, 0.0F}, {1.0F, 5.0F, 1.0F}), box({6.0F, 4.0F, 0.0F}, {1.0F, 5.0F, 1.0F})});
    if (tick == 1)
      commands = {undercut(sphere({0.0F, 1.5F, 0.0F}, 2.0F)), undercut(sphere({6.0F, 1.5F, 0.0F}, 2.0F))};
    const auto a = step(one, commands), b = step(other, commands);
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
    islands += islands_of(*a);
    if (tick == 0) {
      EXPECT_EQ(islands, 0U);
    }
    if (tick >= 3 && tick < 60) {  // later, slopes of the rubble slide
      EXPECT_EQ(islands, 2U) << "one falls at once, the other when the budget has room";
    }
  }
}

TEST(falling, a_client_that_applies_the_same_operations_has_the_same_field_and_pieces) {
  World world(flat_world());
  WelcomeMessage welcome;
  welcome.terrain = world.config().terrain;
  Mirror mirror(welcome);
  size_t islands = 0;
  for (int tick = 0; tick < 60; ++tick) {
    std::vector<Command> commands;
    if (tick == 0) commands = pour_all({box({0.0F, 4.0F, 0.0F}, {1.0F, 5.0F, 1.0F})});
    if (tick == 1) commands = {undercut(sphere({0.0F, 2.0F, 0.0F}, 2.0F))};
    const auto delta = step(world, commands);
    FrameMessage frame;
    frame.tick = delta->tick;
    for (const AppliedOperation& applied : delta->operations) frame.operations.push_back(applied.operation);
    const Result<MirrorChanges> applied = mirror.apply(frame);
    ASSERT_TRUE(applied) << applied.error().message;
    ASSERT_EQ(mirror.field().hash(), delta->field_hash) << "tick " << tick;
    ASSERT_EQ(mirror.pieces().size(), delta->pieces.size()) << "tick " << tick;
    islands += islands_of(*delta);
  }
  EXPECT_EQ(islands, 1U);
  EXPECT_EQ(mirror.counters().operations.of<IslandOperation>(), 1U);
}

TEST(falling, a_recorded_fall_verifies) {
  const auto path =
      std::filesystem::temp_directory_path() / ("scree_falling_" + std::to_string(::getpid()) + ".scree");
  World world(flat_world());
  {
    auto recorder = Recorder::create(path.string(), {"test", world.config()});
    ASSERT_TRUE(recorder.has_value()) << recorder.error().message;
    for (int tick = 0; tick < 120; ++tick) {
      std::vector<Command> commands;
      if (tick == 0) commands = pour_all({box({0.0F, 4.0F, 0.0F}, {1.0F, 5.0F, 1.0F})});
      if (tick == 1) commands = {undercut(sphere({0.0F, 2.0F, 0.0F}, 2.0F))};
      (*recorder)->push(step(world, commands), commands);
    }
    ASSERT_TRUE((*recorder)->finish().has_value());
  }
  expect_verifies(path);
}

}  // namespace
}  // namespace scree
