#include <algorithm>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "shared/base/random.h"

namespace scree {

namespace {

constexpr int blasts = 40;
constexpr int ticks_between_blasts = 10;
constexpr int ticks_to_settle_max = 3600;
/// Ticks without a piece after which nothing waits any more: searches for islands, and specks.
constexpr int quiet_ticks = 120;

/// Half the side of the square that is blasted, and what reaches beyond it, metres.
constexpr float half_width_m = 10.0F, margin_m = 12.0F;

CarveRequest next_blast(const TerrainSource& terrain, Random& random) {
  const auto around = [&] { return half_width_m * (2.0F * random.unit() - 1.0F); };
  const float x_m = around(), z_m = around(), radius_m = 1.0F + 2.0F * random.unit();
  const auto seeds = static_cast<uint32_t>(8 + random.below(57));
  CarveRequest blast =
      blow_at(terrain, x_m, z_m, radius_m, seeds, static_cast<uint32_t>(random.below(UINT32_MAX)));
  // At the ground's undisturbed height, or deeper: what is above falls.
  blast.shape.a.y -= 3.0F * random.unit();
  blast.blast_speed_m_s = 20.0F * random.unit();
  return blast;
}

/// Components of solid voxels that hang loose: no way by their faces leads to the sides or the bottom of the
/// box. Looks at every voxel, unlike the search that it is compared with.
size_t loose_components(const Window& window) {
  const VoxelBox& box = window.box;
  std::vector<bool> seen(window.codes.size(), false);
  size_t loose = 0;
  std::vector<VoxelCoord> ahead;
  const auto enter = [&](VoxelCoord v) {
    const size_t at = window.index(v.x, v.y, v.z);
    if (seen[at] || window.codes[at] >= 0) return;
    seen[at] = true;
    ahead.push_back(v);
  };
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) {
        enter({x, y, z});
        bool held = ahead.empty();
        while (!ahead.empty()) {
          const VoxelCoord v = ahead.back();
          ahead.pop_back();
          held = held || v.x == box.lo.x || v.x + 1 == box.hi.x || v.y == box.lo.y || v.z == box.lo.z ||
                 v.z + 1 == box.hi.z;
          if (v.x > box.lo.x) enter({v.x - 1, v.y, v.z});
          if (v.y > box.lo.y) enter({v.x, v.y - 1, v.z});
          if (v.z > box.lo.z) enter({v.x, v.y, v.z - 1});
          if (v.x + 1 < box.hi.x) enter({v.x + 1, v.y, v.z});
          if (v.y + 1 < box.hi.y) enter({v.x, v.y + 1, v.z});
          if (v.z + 1 < box.hi.z) enter({v.x, v.y, v.z + 1});
        }
        loose += held ? 0 : 1;
      }
  return loose;
}

struct Scene {
  MassUnits dust_least = 0;
  MassUnits dust_last = 0;
  MassUnits error_most = 0;
  size_t alive = 0;
  size_t loose = 0;         ///< components, beyond those of the unedited ground
  size_t loose_before = 0;  ///< in the unedited ground
  size_t carried_out = 0;   ///< blasts
  size_t made = 0;          ///< pieces

  void add(const TickDelta& delta) {
    dust_least = std::min(dust_least, delta.ledger.dust);
    dust_last = delta.ledger.dust;
    error_most = std::max(error_most, std::abs(delta.ledger.error()));
    alive = delta.pieces.size();
    made += delta.spawned.size();
    for (const Reply& reply : delta.replies) carried_out += reply.refusal.empty() ? 1 : 0;
  }
};

Scene play(TerrainKind kind, uint32_t seed) {
  WorldConfig config;
  config.terrain.kind = kind;
  config.terrain.random_seed = seed;
  World world(config);
  const float ground_m = ground_height_m(config.terrain, 0.0F, 0.0F);
  const Shape all = box({0.0F, ground_m, 0.0F}, glm::vec3(half_width_m + margin_m));
  const VoxelBox around = band_box(in_voxels(all, config.terrain.voxel_size_m));
  Random random(seed);
  Scene scene;
  scene.loose_before = loose_components(gather(world.field(), around));
  for (uint32_t i = 0; i < blasts; ++i) {
    const Command command{0, i, next_blast(config.terrain, random)};
    scene.add(*world.step({&command, 1}));
    for (int tick = 1; tick < ticks_between_blasts; ++tick) scene.add(*world.step({}));
  }
  for (int tick = 0, quiet = 0; tick < ticks_to_settle_max && quiet < quiet_ticks; ++tick) {
    scene.add(*world.step({}));
    quiet = scene.alive == 0 ? quiet + 1 : 0;
  }
  const size_t loose = loose_components(gather(world.field(), around));
  scene.loose = loose - std::min(loose, scene.loose_before);
  return scene;
}

}  // namespace

BenchReport run_loose_bench(const BenchOptions& options) {
  const uint32_t scenes = options.quick ? 3 : 35;
  Scene worst;
  for (uint32_t i = 0; i < scenes; ++i) {
    const Scene scene = play(all_kinds<TerrainKind>[i % kind_count<TerrainKind>], i + 1);
    worst.dust_least = std::min(worst.dust_least, scene.dust_least);
    worst.dust_last = std::max(worst.dust_last, scene.dust_last);
    worst.error_most = std::max(worst.error_most, scene.error_most);
    worst.alive += scene.alive;
    worst.loose += scene.loose;
    worst.loose_before += scene.loose_before;
    worst.carried_out += scene.carried_out;
    worst.made += scene.made;
    options.progress(static_cast<double>(i + 1) / scenes);
  }
  BenchReport report;
  report.metric("scenes", scenes);
  report.metric("blasts_a_scene", blasts);
  report.metric("carried_out", static_cast<double>(worst.carried_out));
  report.metric("pieces", static_cast<double>(worst.made));
  report.metric("dust_least_units", static_cast<double>(worst.dust_least));
  report.metric("dust_last_most_units", static_cast<double>(worst.dust_last));
  report.check("dust", worst.dust_least >= 0 && worst.error_most == 0,
               fmt::format("{} units at least in any tick, ledger off by {}; wanted 0 and 0",
                           worst.dust_least, worst.error_most));
  report.check("loose", worst.loose == 0,
               fmt::format("{} components hang loose at the end, wanted 0; {} did in the unedited ground",
                           worst.loose, worst.loose_before));
  report.check("settled", worst.alive == 0, fmt::format("{} pieces are left", worst.alive));
  return report;
}

}  // namespace scree
