// A world of edited terrain, 64 m to 4 km a side: a blow each 32 m. What happens in its middle is the same in
// all.
#include <filesystem>
#include <fmt/format.h>

#include "studies/scale/axes.h"
#include "studies/scale/ground_probe.h"
#include "studies/scale/worlds_on_disk.h"

namespace scree {

namespace {

constexpr float blows_apart_m = 32.0F;
constexpr float world_interest_m = 256.0F;
constexpr double flat_exponent_max = 0.05;

CarvedGround wide_ground(int side_m) {
  CarvedGround ground;
  ground.config.terrain = {TerrainKind::noise, 5, 0.25F};
  ground.carves_a_side = static_cast<uint32_t>(static_cast<float>(side_m) / blows_apart_m);
  ground.spacing_m = blows_apart_m;
  ground.radius_m = 2.0F;
  return ground;
}

/// Files, starts and joins, each world alone.
Result<void> weigh_worlds(Axis& axis, const ScaleRun& run, const std::vector<int>& sides_m,
                          const std::vector<std::string>& paths) {
  for (size_t i = 0; i < paths.size(); ++i) {
    const auto joined = TRY(join_cost(paths[i], wide_ground(sides_m[i]).config, world_interest_m));
    axis.curve("bytes of a join", measure::size_mib).add(sides_m[i], joined.kib / 1024.0);
    axis.curve("file", measure::size_mib)
        .add(sides_m[i], static_cast<double>(std::filesystem::file_size(paths[i])) / 1048576.0);
  }
  run.progress(0.5);
  return {};
}

Result<void> probe_worlds(Axis& axis, const ScaleRun& run, const std::vector<int>& sides_m,
                          const std::vector<std::string>& paths) {
  std::vector<OpenedWorld> worlds;
  std::vector<GroundProbe> probes;
  for (size_t i = 0; i < paths.size(); ++i) {
    auto opened = TRY(open_world(paths[i], wide_ground(sides_m[i]).config));
    axis.curve("memory", measure::size_mib).add(sides_m[i], opened.heap_mib);
    axis.curve("start", measure::time_ms).add(sides_m[i], opened.start_ms);
    probes.emplace_back(*opened.world, 0.0F, 0.0F);
    worlds.push_back(std::move(opened));
  }
  const int rounds = run.quick ? 3 : 16;
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < probes.size(); ++i) add(axis, sides_m[i], probes[i].round());
    run.progress(0.5 + 0.5 * (round + 1) / rounds);
  }
  check_alike(axis, probes);
  return {};
}

}  // namespace

Result<Axis> measure_world_axis(const ScaleRun& run) {
  Axis axis{"world", "World size", "side of the edited world, m", "m"};
  const std::vector<int> sides_m =
      run.quick ? std::vector<int>{64, 128, 256, 512} : std::vector<int>{64, 128, 256, 512, 1024, 2048, 4096};
  std::vector<CarvedGround> grounds;
  for (const int side_m : sides_m) grounds.push_back(wide_ground(side_m));
  const auto paths = TRY(worlds_on_disk(run.worlds, grounds));
  run.progress(0.4);
  TRY(weigh_worlds(axis, run, sides_m, paths));
  TRY(probe_worlds(axis, run, sides_m, paths));
  for (const char* name : {"carve", "merge", "islands"})
    axis.curve(name, measure::time_ms).flat(flat_exponent_max);
  axis.curve("tick with pieces", measure::time_ms).limit(1000.0 / 60.0, "a tick of 16.6 ms");
  axis.curve("memory", measure::size_mib).limit(4096.0, "`memory-max` as it is unless set, 4,096 MB");
  axis.text.push_back(
      "Each world is a file of noise ground in voxels of 0.25 m with a blow of 2 m each 32 m, opened as a "
      "server opens "
      "it. The blows, falls and merges that are timed are the same in the middle of all worlds, and take "
      "turns: each "
      "round goes through all sizes. A blow of 2 m makes 64 pieces; its merge is that of all of them; an "
      "island is a "
      "post of 9 m whose foot is cut. Times are medians of the rounds by the clock, on the simulation's "
      "thread; the "
      "start is processor time. Memory is the heap of the opened world.");
  axis.text.push_back(
      fmt::format("A join receives the edits within {:.0f} m, so it stops growing where the world "
                  "does not fit into that any more.",
                  world_interest_m));
  return axis;
}

}  // namespace scree
