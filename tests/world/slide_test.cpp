// Slopes of rubble in a world: they slide within the budget, by rules::slides, and come to an end.
#include <gtest/gtest.h>

#include "bench/support/heap_shape.h"
#include "content/builtin_palette.h"
#include "server/world/slide_stage.h"
#include "tests/support/flat_world.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

Material rubble_of_rock() {
  return *builtin_palette().named("rock_rubble");
}

Command pour(const Shape& shape, Material of) {
  return {1, 1, FillRequest{shape, of}};
}

const Shape block = box({0.0F, 1.75F, 0.0F}, {2.5F, 2.0F, 2.5F});
constexpr VoxelBox around{{-40, -16, -40}, {40, 48, 40}};

size_t slides_of(const TickDelta& delta) {
  return static_cast<size_t>(std::ranges::count_if(delta.operations, [](const AppliedOperation& applied) {
    return std::holds_alternative<SlideOperation>(applied.operation);
  }));
}

/// A world, and a client's field that gets nothing but its operations.
struct Followed {
  explicit Followed(const WorldConfig& config) : world(config), field(world.config().terrain) {}

  size_t step(const std::vector<Command>& commands = {}) {
    const auto delta = world.step(commands);
    for (const AppliedOperation& applied : delta->operations) {
      EXPECT_TRUE(validate(applied.operation, pieces, field.source().voxel_size_m));
      apply(applied.operation, field, pieces);
    }
    EXPECT_EQ(delta->field_hash, field.hash());
    EXPECT_EQ(delta->ledger.error(), 0);
    EXPECT_EQ(world.measure_terrain(), delta->ledger.terrain) << "tick " << delta->tick;
    last = delta;
    return slides_of(*delta);
  }
  /// Until nothing has slid, and nothing waits, for a second. Returns how many slides there were.
  size_t settle(int ticks_max = 1200) {
    size_t slides = 0;
    for (int tick = 0, quiet = 0; tick < ticks_max && quiet < 60; ++tick) {
      const size_t now = step();
      slides += now;
      quiet = now == 0 && last->work.slides_put_off == 0 ? quiet + 1 : 0;
      ended = quiet == 60;
    }
    return slides;
  }

  World world;
  MapField field;
  PieceTable pieces;
  std::shared_ptr<const TickDelta> last;
  bool ended = false;
};

TEST(slides, a_block_of_rubble_runs_down_and_clients_follow) {
  Followed followed(rock_world());
  followed.step({pour(block, rubble_of_rock())});
  const MassUnits poured = followed.last->ledger.terrain;
  EXPECT_GT(followed.settle(), 5U);
  EXPECT_TRUE(followed.ended);
  EXPECT_EQ(followed.last->ledger.terrain, poured);
  EXPECT_EQ(followed.world.measure_terrain(), poured);
  const HeapShape shape(followed.world.field(), around);
  EXPECT_GE(shape.flank_deg(0.0), 33.0);
  EXPECT_LE(shape.steepest_deg(), 40.0);
}

TEST(slides, rock_and_soil_stand_and_older_worlds_do_too) {
  for (const char* name : {"rock", "soil", "clay"}) {
    Followed followed(rock_world());
    followed.step({pour(block, *builtin_palette().named(name))});
    EXPECT_EQ(followed.settle(), 0U) << name;
  }
  WorldConfig older = rock_world();
  older.rules = rules::by_place;
  Followed followed(older);
  followed.step({pour(block, rubble_of_rock())});
  EXPECT_EQ(followed.settle(), 0U);
}

TEST(slides, a_restored_world_goes_on_sliding) {
  Followed followed(rock_world());
  followed.step({pour(block, rubble_of_rock())});
  followed.step();
  const WorldSnapshot kept = followed.world.snapshot();
  ASSERT_FALSE(kept.moment.slopes.empty());
  auto restored = World::restore(kept);
  ASSERT_TRUE(restored) << restored.error().message;
  EXPECT_TRUE((*restored)->snapshot().moment.slopes == kept.moment.slopes);
  for (int tick = 0; tick < 200; ++tick) {
    followed.step();
    EXPECT_EQ((*restored)->step({})->field_hash, followed.last->field_hash);
  }
}

TEST(slides, repose_is_friction_and_what_holds_together_has_none) {
  const Palette& palette = builtin_palette();
  const auto angle = [&](const char* name) {
    const auto tangent = repose_of(palette.row(*palette.named(name)));
    return tangent ? std::atan(*tangent / 64.0) * 57.29578 : 0.0;
  };
  EXPECT_NEAR(angle("rock_rubble"), 38.0, 0.5);
  EXPECT_NEAR(angle("gravel"), 38.0, 0.5);
  EXPECT_NEAR(angle("sand"), 33.8, 0.5);
  EXPECT_EQ(angle("rock"), 0.0);
  EXPECT_EQ(angle("soil"), 0.0);
  EXPECT_EQ(angle("clay"), 0.0);
}

}  // namespace
}  // namespace scree
