// Worlds after 1 to 100,000 carves: 2 m apart, so that the carved ground grows with them; and a picture whose
// hundred places are carved again and again.
#include <array>
#include <filesystem>
#include <fmt/format.h>

#include "studies/scale/axes.h"
#include "studies/scale/frame_set.h"
#include "studies/scale/ground_probe.h"
#include "studies/scale/worlds_on_disk.h"

namespace scree {

namespace {

constexpr float carved_interest_m = 48.0F;
constexpr float beside_m = 400.0F;  ///< ground that no world has carved: half of the largest is 316 m wide
constexpr float drawn_radius_m = 0.75F;
constexpr double carves_flat_max = 0.05;

CarvedGround dense_ground(uint32_t carves_a_side) {
  CarvedGround ground;
  ground.config.terrain = {TerrainKind::noise, 5, 0.25F};
  ground.carves_a_side = carves_a_side;
  return ground;
}

double carves_of(const CarvedGround& ground) {
  return static_cast<double>(ground.carves_a_side) * ground.carves_a_side;
}

Result<void> weigh_carved(Axis& axis, const std::vector<CarvedGround>& grounds,
                          const std::vector<std::string>& paths) {
  for (size_t i = 0; i < paths.size(); ++i) {
    const auto joined = TRY(join_cost(paths[i], grounds[i].config, carved_interest_m));
    axis.curve("bytes of a join", measure::size_mib).add(carves_of(grounds[i]), joined.kib / 1024.0);
    axis.curve("file", measure::size_mib)
        .add(carves_of(grounds[i]), static_cast<double>(std::filesystem::file_size(paths[i])) / 1048576.0);
  }
  return {};
}

Result<void> probe_carved(Axis& axis, const ScaleRun& run, const std::vector<CarvedGround>& grounds,
                          const std::vector<std::string>& paths) {
  std::vector<OpenedWorld> worlds;
  std::vector<GroundProbe> probes;
  for (size_t i = 0; i < paths.size(); ++i) {
    auto opened = TRY(open_world(paths[i], grounds[i].config));
    axis.curve("memory", measure::size_mib).add(carves_of(grounds[i]), opened.heap_mib);
    axis.curve("start", measure::time_ms).add(carves_of(grounds[i]), opened.start_ms);
    probes.emplace_back(*opened.world, beside_m, 0.0F);
    worlds.push_back(std::move(opened));
  }
  const int rounds = run.quick ? 3 : 16;
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < probes.size(); ++i) add(axis, carves_of(grounds[i]), probes[i].round());
    run.progress(0.3 + 0.3 * (round + 1) / rounds);
  }
  check_alike(axis, probes);
  return {};
}

Result<void> draw_carved(Axis& axis, const ScaleRun& run) {
  FrameSet frames(*run.stage);
  const TerrainSource terrain{TerrainKind::noise, 1, 0.25F};
  const std::vector<int> counts =
      run.quick ? std::vector<int>{100, 1024} : std::vector<int>{100, 1024, 10000, 99856};
  for (const int carves : counts) {
    TRY(frames.add(carves, terrain, carves, drawn_radius_m));
    run.progress(0.6 + 0.3 * carves / counts.back());
  }
  auto measured = frames.measure(axis, run.quick ? 3 : 15);
  frames.curve(axis).flat(carves_flat_max);
  return measured;
}

}  // namespace

Result<Axis> measure_carves_axis(const ScaleRun& run) {
  Axis axis{"carves", "Carves", "carves", "carves"};
  std::vector<CarvedGround> grounds;
  for (const uint32_t side : {1U, 3U, 10U, 32U, 100U, 316U})
    if (!run.quick || side <= 32) grounds.push_back(dense_ground(side));
  const auto paths = TRY(worlds_on_disk(run.worlds, grounds));
  TRY(weigh_carved(axis, grounds, paths));
  run.progress(0.3);
  TRY(probe_carved(axis, run, grounds, paths));
  if (run.stage != nullptr) TRY(draw_carved(axis, run));
  axis.curve("tick with pieces", measure::time_ms).limit(1000.0 / 60.0, "a tick of 16.6 ms");
  axis.curve("memory", measure::size_mib).limit(4096.0, "`memory-max` as it is unless set, 4,096 MB");
  axis.curve("start", measure::time_ms).limit(10000.0, "a start of 10 s");
  axis.text.push_back(
      fmt::format("Each world is a file of noise ground in voxels of 0.25 m with carves of 1.25 m, {:.0f} m "
                  "apart in a square, as they "
                  "are when their pieces are gone. Blows, falls and merges are timed on ground that no world "
                  "has carved, {:.0f} m from "
                  "the middle, the same in all worlds, in turns; they are medians by the clock. The start is "
                  "processor time, the "
                  "memory the heap of the opened world. A join receives the edits within {:.0f} m.",
                  dense_ground(1).spacing_m, beside_m, carved_interest_m));
  if (run.stage != nullptr)
    axis.text.push_back(
        fmt::format("The frame has 640 × 360 pixels and shows {} places of {} m, which are filled and carved "
                    "again: the picture is the "
                    "same after any number of carves. The fastest of the rounds counts.",
                    Drawing::carved_places, drawn_radius_m));
  return axis;
}

}  // namespace scree
