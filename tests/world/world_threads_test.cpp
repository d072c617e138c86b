// A world whose bodies are stepped by several threads: the same hashes at every tick as by one, while rock
// breaks, falls, breaks again and merges.
#include <gtest/gtest.h>
#include <string>
#include <variant>

#include "bench/support/scenes.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

struct Stormy {
  std::vector<uint64_t> hashes;  ///< of state and field, by tick
  size_t alive_most = 0;
  size_t shattered = 0;
  size_t merged = 0;
};

Stormy storm(TerrainColliderKind collider, size_t threads) {
  WorldConfig config;
  config.methods.collider = collider;
  World world(config, threads);
  BlowGrid blows(config.terrain, 2, 4.5F, 1.5F, 32);
  Stormy seen;
  for (uint32_t tick = 0; tick < 80; ++tick) {
    std::vector<Command> commands;
    if (tick % 8 == 0)
      if (auto blow = blows.next()) {
        blow->blast_speed_m_s = 25.0F;
        commands.push_back({0, tick, *blow});
      }
    const auto delta = step(world, commands);
    seen.hashes.insert(seen.hashes.end(), {delta->state_hash, delta->field_hash});
    seen.alive_most = std::max(seen.alive_most, delta->pieces.size());
    for (const AppliedOperation& applied : delta->operations) {
      seen.shattered += std::holds_alternative<ShatterOperation>(applied.operation) ? 1 : 0;
      seen.merged += pieces_merged_by(applied.operation);
    }
  }
  return seen;
}

class WorldThreads : public ::testing::TestWithParam<TerrainColliderKind> {};
INSTANTIATE_TEST_SUITE_P(Colliders, WorldThreads,
                         ::testing::Values(TerrainColliderKind::field, TerrainColliderKind::mesh,
                                           TerrainColliderKind::rays),
                         [](const auto& info) { return std::string(row_of(info.param).name); });

TEST_P(WorldThreads, make_no_difference_to_a_storm) {
  const Stormy alone = storm(GetParam(), 1);
  EXPECT_GT(alone.alive_most, 100U);
  EXPECT_GT(alone.shattered, 0U);
  EXPECT_GT(alone.merged, 0U);
  for (const size_t threads : {2U, 4U}) EXPECT_EQ(storm(GetParam(), threads).hashes, alone.hashes) << threads;
}

}  // namespace
}  // namespace scree
