// A world takes a configuration within its limits, and runs with all of them; another it refuses, by name.
#include "server/world/world_config.h"

#include <gtest/gtest.h>
#include <limits>

#include "server/formats/recording_codec.h"
#include "server/world/limits.h"
#include "server/world/recorded_values.h"
#include "server/world/settings.h"
#include "server/world/world.h"
#include "shared/base/edit_reach.h"
#include "shared/base/limits.h"
#include "shared/base/spawn.h"
#include "shared/base/water.h"
#include "tests/support/rounds.h"

namespace scree {
namespace {

WorldConfig world_of(float voxel_size_m, uint32_t tick_rate_hz) {
  WorldConfig config;
  config.terrain = {TerrainKind::flat, 1, voxel_size_m};
  config.tick_rate_hz = tick_rate_hz;
  return config;
}

std::string refusal(const WorldConfig& config) {
  const auto world = World::create(config);
  return world ? std::string() : world.error().message;
}

void expect_refused(const WorldConfig& config, const std::string& limit) {
  EXPECT_NE(refusal(config).find(limit), std::string::npos) << limit << ": " << refusal(config);
}

TEST(WorldConfig, voxels_beyond_the_limits_are_refused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float size_m : {0.05F, 0.0F, -0.25F, nan, infinite, 5.0F, limits::voxel_size_min_m * 0.999F,
                             limits::voxel_size_max_m * 1.001F})
    expect_refused(world_of(size_m, 60), "limits.voxel_size_min_m, voxel_size_max_m");
  EXPECT_NE(refusal(world_of(0.05F, 60)).find("voxel_size_m is 0.05, not within 0.1 to 2 "),
            std::string::npos);
}

TEST(WorldConfig, rates_and_numbers_beyond_the_limits_are_refused) {
  for (const uint32_t rate_hz :
       {0U, limits::tick_rate_min_hz - 1, limits::tick_rate_max_hz + 1, 100'000U, UINT32_MAX})
    expect_refused(world_of(0.25F, rate_hz), "tick_rate_max_hz");
  for (const uint32_t pieces : {0U, limits::pieces_max_max + 1, UINT32_MAX}) {
    WorldConfig config;
    config.pieces_max = pieces;
    expect_refused(config, "limits.pieces_max_min, pieces_max_max");
  }
  for (const uint32_t merges : {limits::merges_per_tick_max_max + 1, UINT32_MAX}) {
    WorldConfig config;
    config.merges_per_tick_max = merges;
    expect_refused(config, "limits.merges_per_tick_max_max");
  }
  WorldConfig config;
  config.terrain.kind = static_cast<TerrainKind>(99);
  expect_refused(config, "kind of terrain");
}

/// The largest carve, in one piece and in many, falls back and becomes terrain again; World::step checks the
/// ledger.
struct Ends {
  float voxel_size_m;
  uint32_t tick_rate_hz;
  Recombination recombine;
};

class WorldAtItsEnds : public ::testing::TestWithParam<Ends> {};

TEST_P(WorldAtItsEnds, carves_throws_and_merges) {
  WorldConfig config = world_of(GetParam().voxel_size_m, GetParam().tick_rate_hz);
  config.methods.recombine = GetParam().recombine;
  const auto world = World::create(config);
  ASSERT_TRUE(world) << world.error().message;
  CarveRequest whole;
  const float reach_m = greatest_edit_reach_m(GetParam().voxel_size_m);
  whole.shape = box({0.0F, 1.0F - reach_m, 0.0F}, glm::vec3(reach_m));
  whole.seeds = 1;
  whole.blast_speed_m_s = limits::blast_speed_max_m_s;
  CarveRequest many = whole;
  many.shape = sphere({40.0F, -0.5F * reach_m, 0.0F}, reach_m);
  many.pattern = SeedPattern::radial;
  many.seeds = 64;
  const Command carves[] = {{1, 1, whole}, {0, 1, many}};
  auto delta = (*world)->step(carves);
  size_t alive = delta->pieces.size();
  while (delta->work.requests_waiting + delta->work.refractures_put_off > 0) {
    delta = (*world)->step({});
    alive = std::max(alive, delta->pieces.size());
  }
  EXPECT_GE(alive, 32U);
  size_t merged = 0;
  for (uint32_t tick = 0; tick < rounds(12U, 4U) * config.tick_rate_hz && !delta->pieces.empty(); ++tick) {
    delta = (*world)->step({});
    merged += std::ranges::count_if(delta->operations, [](const AppliedOperation& applied) {
      return std::holds_alternative<StampOperation>(applied.operation);
    });
  }
  EXPECT_GT(merged, 0U) << "nothing came to rest";
  EXPECT_EQ((*world)->measure_terrain(), delta->ledger.terrain);
}

INSTANTIATE_TEST_SUITE_P(
    both, WorldAtItsEnds,
    ::testing::Values(Ends{limits::voxel_size_min_m, 60, Recombination::stamp},
                      Ends{limits::voxel_size_min_m, limits::tick_rate_min_hz, Recombination::sphere},
                      Ends{limits::voxel_size_max_m, limits::tick_rate_min_hz, Recombination::stamp},
                      Ends{limits::voxel_size_max_m, 60, Recombination::slices},
                      Ends{0.25F, limits::tick_rate_min_hz, Recombination::stamp},
                      Ends{0.25F, limits::tick_rate_max_hz, Recombination::stamp}),
    [](const auto& info) {
      return "voxels_" + std::to_string(static_cast<int>(info.param.voxel_size_m * 100.0F)) + "_cm_at_" +
             std::to_string(info.param.tick_rate_hz) + "_hz";
    });

TEST(WorldConfig, what_is_set_is_what_files_and_clients_read) {
  for (const SettingValue& setting : SettingValues{{"reach", "1e-31"},
                                                   {"reach", "1e-40"},
                                                   {"reach", "1e-320"},
                                                   {"reach", "-0"},
                                                   {"reach", "3.3333333333"},
                                                   {"requests-per-second", "1.000000000001"},
                                                   {std::string(water_setting), "1.234567"},
                                                   {std::string(spawn_setting), "1.23456,10,3.33333"},
                                                   {std::string(spawn_setting), "1e-31,1,1"}}) {
    WorldConfig config = world_of(0.25F, 60), again = config;
    ASSERT_TRUE(set(config, setting)) << setting.value;
    ASSERT_TRUE(set_all(again, print(config))) << setting.value;
    EXPECT_TRUE(again == config) << setting.name << "=" << setting.value;
    EXPECT_TRUE(World(config).config() == config) << setting.name << "=" << setting.value;
  }
  WorldConfig of_host = world_of(0.25F, 60);
  of_host.water = 1.234567F;
  EXPECT_EQ(World(of_host).config().water, 1.23F);
}

/// A later release may have another built-in palette.
TEST(WorldConfig, a_header_names_the_built_in_palette_too) {
  const RecordedHeader header = to_recorded(WorldConfig{});
  ASSERT_NE(header.palette, nullptr);
  EXPECT_EQ(*header.palette, builtin_palette());
  const auto decoded = decode_recorded_header(encode(header));
  ASSERT_TRUE(decoded && decoded->palette != nullptr);
  EXPECT_EQ(*decoded->palette, builtin_palette());
}

}  // namespace
}  // namespace scree
