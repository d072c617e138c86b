// The same blows, falls and pictures in voxels of 1 m to 0.15 m.
#include <fmt/format.h>
#include <memory>

#include "studies/scale/axes.h"
#include "studies/scale/frame_set.h"
#include "studies/scale/ground_probe.h"
#include "studies/scale/worlds_on_disk.h"

namespace scree {

namespace {

constexpr float voxel_interest_m = 48.0F;
constexpr int carves_drawn = 100;

TerrainSource terrain_of(float voxel_m) {
  return {TerrainKind::noise, 5, voxel_m};
}

Result<void> probe_voxels(Axis& axis, const ScaleRun& run, const std::vector<float>& voxels_m) {
  std::vector<std::unique_ptr<World>> worlds;
  std::vector<GroundProbe> probes;
  for (const float voxel_m : voxels_m) {
    WorldConfig config;
    config.terrain = terrain_of(voxel_m);
    worlds.push_back(std::make_unique<World>(config));
    probes.emplace_back(*worlds.back(), 0.0F, 0.0F);
  }
  const int rounds = run.quick ? 2 : 16;
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < probes.size(); ++i) add(axis, static_cast<double>(voxels_m[i]), probes[i].round());
    run.progress(0.6 * (round + 1) / rounds);
  }
  for (size_t i = 0; i < probes.size(); ++i) {
    const auto voxel_m = static_cast<double>(voxels_m[i]);
    const auto bricks = static_cast<double>(worlds[i]->field().edited_brick_count());
    axis.curve("edited bricks", measure::size_mib).add(voxel_m, bricks * sizeof(Brick) / 1048576.0);
    axis.curve("pieces of a blow and a fall", "count")
        .add(voxel_m, static_cast<double>(probes[i].counts().pieces) / rounds);
  }
  return {};
}

Result<void> join_voxels(Axis& axis, const ScaleRun& run, const std::vector<float>& voxels_m) {
  std::vector<CarvedGround> grounds;
  for (const float voxel_m : voxels_m) {
    grounds.push_back({.config = {}, .carves_a_side = 4, .spacing_m = 8.0F, .radius_m = 2.0F});
    grounds.back().config.terrain = terrain_of(voxel_m);
  }
  const auto paths = TRY(worlds_on_disk(run.worlds, grounds));
  for (size_t i = 0; i < paths.size(); ++i) {
    const auto joined = TRY(join_cost(paths[i], grounds[i].config, voxel_interest_m));
    axis.curve("bytes of a join", measure::size_mib)
        .add(static_cast<double>(voxels_m[i]), joined.kib / 1024.0);
  }
  return {};
}

Result<void> draw_voxels(Axis& axis, const ScaleRun& run, const std::vector<float>& voxels_m) {
  FrameSet frames(*run.stage);
  for (const float voxel_m : voxels_m) {
    const auto added = frames.add(static_cast<double>(voxel_m), terrain_of(voxel_m), carves_drawn, 1.5F);
    if (!added) return added;
  }
  return frames.measure(axis, run.quick ? 2 : 8);
}

void tell_voxels(Axis& axis) {
  axis.text.push_back(
      "The same noise ground, blows of 2 m and posts of 9 m in coarse and in fine voxels. Times are medians "
      "of "
      "rounds over all sizes by the clock. A blow asks for 64 pieces; in voxels of 0.5 m and more some of "
      "them "
      "would be smaller than two voxels, and join others: so what depends on pieces falls faster there.");
  const auto bricks = axis.curve("edited bricks", measure::size_mib).law();
  const auto carve = axis.curve("carve", measure::time_ms).law_at_end();
  if (bricks && carve)
    axis.text.push_back(fmt::format(
        "Surfaces have the exponent -2, volumes -3. Bricks that are edited have {:.2f}; a carve has "
        "{:.2f} over the smallest three voxels.",
        bricks->exponent, carve->exponent));
  axis.text.push_back(fmt::format(
      "A join receives 16 blows of 2 m within {:.0f} m. The frame has 640 × 360 pixels and shows {} "
      "carves of 1.5 m; it is the fastest of the rounds.",
      voxel_interest_m, carves_drawn));
}

}  // namespace

Result<Axis> measure_voxel_axis(const ScaleRun& run) {
  Axis axis{"voxel", "Voxel size", "voxel size, m", "m"};
  const std::vector<float> voxels_m = run.quick
                                          ? std::vector<float>{1.0F, 0.5F, 0.25F}
                                          : std::vector<float>{1.0F, 0.7F, 0.5F, 0.35F, 0.25F, 0.2F, 0.15F};
  TRY(probe_voxels(axis, run, voxels_m));
  TRY(join_voxels(axis, run, voxels_m));
  run.progress(0.75);
  if (run.stage != nullptr) TRY(draw_voxels(axis, run, voxels_m));
  axis.curve("carve", measure::time_ms).limit(1000.0 / 60.0, "a tick of 16.6 ms");
  axis.curve("tick with pieces", measure::time_ms).limit(1000.0 / 60.0, "a tick of 16.6 ms");
  axis.curve("islands", measure::time_ms).limit(1000.0 / 60.0, "a tick of 16.6 ms");
  tell_voxels(axis);
  return axis;
}

}  // namespace scree
