// What a blast leaves: a hole, and its rock beyond the rim.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "server/formats/world_codec.h"
#include "server/world/world_snapshot.h"
#include "shared/field/field.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

/// The ground at and around the origin of a flat world.
struct Ground {
  float depth_m = 0.0F;                              ///< of the deepest place
  float below_m3 = 0.0F;                             ///< of air below 0
  float inner_heap_m3 = 0.0F, outer_heap_m3 = 0.0F;  ///< above 0, up to and beyond a distance
};

Ground ground_of(const Field& field, float half_m, float rim_m) {
  constexpr float thin_m = 0.02F;  // codes are coarser
  const float dx = field.source().voxel_size_m, above_m = 10.0F, column_m2 = dx * dx;
  const auto places = static_cast<int>(half_m / dx);
  Ground ground;
  for (int x = -places; x <= places; ++x)
    for (int z = -places; z <= places; ++z) {
      const glm::vec3 from(static_cast<float>(x), above_m / dx, static_cast<float>(z));
      const auto down = trace(field, from, {0.0F, -1.0F, 0.0F}, 30.0F / dx);
      if (!down) continue;
      const float height_m = above_m - *down * dx;
      if (height_m < 0.0F) {
        ground.depth_m = std::max(ground.depth_m, -height_m);
        ground.below_m3 -= height_m * column_m2;
        continue;
      }
      if (height_m < thin_m) continue;
      const bool is_inner = static_cast<float>(x * x + z * z) * column_m2 < rim_m * rim_m;
      (is_inner ? ground.inner_heap_m3 : ground.outer_heap_m3) += height_m * column_m2;
    }
  return ground;
}

/// A blast at the surface of flat rock, and the ground after all has come to rest.
struct Blasted {
  Ground at_once, after;
  double broken_m3 = 0.0;
  float radius_m = 0.0F;
};

Blasted blasted(float energy_j, uint32_t seed, uint32_t by_rules) {
  WorldConfig config = rock_world();
  config.rules = by_rules;
  PropWorld world(config);
  world.step();
  EXPECT_EQ(world.ask(BlastRequest{{0.0F, 0.0F, 0.0F}, energy_j, seed}).refusal, "");
  Blasted result;
  const double voxel_m3 = std::pow(static_cast<double>(voxel_m), 3.0);
  result.broken_m3 = -static_cast<double>(world.last().ledger.terrain) / units_per_voxel * voxel_m3;
  result.at_once = ground_of(world.world().field(), 8.0F, 8.0F);
  result.radius_m = result.at_once.depth_m;
  int ticks = 0;
  while ((ticks < 10 || !world.last().pieces.empty()) && ticks < 60 * 30) {
    world.step();
    ++ticks;
  }
  EXPECT_TRUE(world.last().pieces.empty()) << "something has not come to rest";
  EXPECT_EQ(world.last().ledger.error(), 0);
  EXPECT_EQ(world.world().measure_terrain(), world.last().ledger.terrain);
  result.after = ground_of(world.world().field(), 60.0F, 1.25F * result.radius_m);
  std::printf(
      "%.1e J by rules %u: %.2f m³ broken, %.2f m deep; at rest %.2f m deep, %.2f m³, heaps %.2f m³ "
      "and %.2f m³ beyond the rim\n",
      static_cast<double>(energy_j), by_rules, result.broken_m3, static_cast<double>(result.at_once.depth_m),
      static_cast<double>(result.after.depth_m), static_cast<double>(result.after.below_m3),
      static_cast<double>(result.after.inner_heap_m3), static_cast<double>(result.after.outer_heap_m3));
  return result;
}

TEST(Crater, of_the_usual_blast_stays_open) {
  for (const uint32_t seed : {1U, 2U, 3U}) {
    const Blasted one = blasted(BlastRequest().energy_j, seed, rules::newest);
    EXPECT_GT(one.after.depth_m, 0.5F);
    EXPECT_GT(one.after.below_m3, 0.5F);
  }
}

TEST(Crater, is_filled_again_by_the_rules_of_older_recordings) {
  EXPECT_LT(blasted(BlastRequest().energy_j, 1, rules::paid_looks).after.depth_m, 0.2F);
}

/// An apparent crater is about half as deep as the true one (H. J. Melosh, Impact Cratering, 1989, chapter
/// 5).
TEST(Crater, keeps_a_third_of_its_depth_or_more_and_its_rock_lies_beyond_the_rim) {
  for (const float energy_j : {1e8F, 4e8F})
    for (const uint32_t seed : {1U, 2U}) {
      const Blasted one = blasted(energy_j, seed, rules::newest);
      EXPECT_GT(one.after.depth_m, one.at_once.depth_m / 3.0F);
      EXPECT_LT(one.after.depth_m, one.at_once.depth_m) << "some of it falls back";
      EXPECT_GT(one.after.below_m3, 0.2F * static_cast<float>(one.broken_m3));
      EXPECT_GT(one.after.outer_heap_m3, 3.0F * one.after.inner_heap_m3);
    }
}

/// The blast of a large charge is cut in later ticks; what waits for its cut is kept.
TEST(Crater, is_thrown_out_after_a_restart_too) {
  WorldConfig config = rock_world();
  PropWorld world(config);
  world.step();
  EXPECT_EQ(world.ask(BlastRequest{{0.0F, 0.0F, 0.0F}, 1e10F, 1}).refusal, "");
  const auto kept = decode_world(encode(world.world().snapshot()));
  ASSERT_TRUE(kept) << kept.error().message;
  ASSERT_FALSE(kept->moment.refractures.empty());
  ASSERT_NE(kept->moment.refractures.front().thrown_by, nullptr);
  EXPECT_TRUE(kept->moment.refractures.front().blasted);
  const auto high_after = [](WorldSnapshot value, bool blast) {
    for (PendingRefracture& cut : value.moment.refractures) cut.blasted = blast;
    const auto restored = World::restore(value);
    EXPECT_TRUE(restored) << restored.error().message;
    std::shared_ptr<const TickDelta> delta;
    for (int tick = 0; tick < 60; ++tick) delta = (*restored)->step({});
    return std::ranges::count_if(
        delta->pieces, [](const PieceState& piece) { return dequantise(piece.pose).position_m.y > 2.0F; });
  };
  EXPECT_GT(high_after(*kept, true), 10 + 2 * high_after(*kept, false));
}

}  // namespace
}  // namespace scree
