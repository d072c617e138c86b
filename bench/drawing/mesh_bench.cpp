// How fast the changed rock becomes triangles: one block of 16³ voxels by either polygoniser, the quads of a
// whole scene beside those of OpenVDB's volumeToMesh, and the time from a change to its picture.
#include <fmt/format.h>

#include "bench/peers/volume_to_mesh.h"
#include "bench/support/benches.h"
#include "bench/support/drawing.h"
#include "bench/support/scenes.h"
#include "client/render/levels/block_windows.h"
#include "client/render/meshing/mesh_scheduler.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

const TerrainSource terrain{TerrainKind::canyon, 1, 0.25F};
const VoxelBox scene_box{{-128, -48, -128}, {128, 144, 128}};
constexpr int scene_carves = 60;

/// Carved over and over in its middle; returns the bricks that changed.
std::vector<BrickCoord> carve_scene(Field& field) {
  std::vector<BrickCoord> changed;
  PieceTable pieces;
  PieceId next = 1;
  ScatteredBlows blows(terrain, 24.0F, 2.0F, 16, 5);
  for (int i = 0; i < scene_carves; ++i) {
    const CarveRequest blow = blows.next();
    const Applied applied =
        apply(CarveOperation{blow.shape, blow.pattern, blow.seeds, blow.random_seed, blow.impact_m, next},
              field, pieces);
    next += static_cast<PieceId>(applied.created.size());
    changed.insert(changed.end(), applied.changed.begin(), applied.changed.end());
  }
  return changed;
}

VoxelBox box_of(BlockCoord block) {
  const VoxelCoord lo{block.x * block_size, block.y * block_size, block.z * block_size};
  return {lo, lo + VoxelCoord{block_size, block_size, block_size}};
}

/// All blocks of the scene.
std::vector<BlockCoord> scene_blocks() {
  std::vector<BlockCoord> blocks;
  for (int x = scene_box.lo.x / block_size; x < scene_box.hi.x / block_size; ++x)
    for (int y = scene_box.lo.y / block_size; y < scene_box.hi.y / block_size; ++y)
      for (int z = scene_box.lo.z / block_size; z < scene_box.hi.z / block_size; ++z)
        blocks.push_back({x, y, z});
  return blocks;
}

/// Median over the rounds of the mean time of one call, microseconds.
template <typename F>
double median_us(int rounds, size_t calls, F&& all) {
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i) {
    Stopwatch stopwatch;
    all();
    times.push_back(stopwatch.lap_ms() * 1000.0 / static_cast<double>(calls));
  }
  return quantile(times, 0.5);
}

/// Windows of blocks that a carve changed and that hold a surface.
std::vector<BlockWindows> dirty_windows(Field& field, const std::vector<BrickCoord>& changed) {
  std::unordered_set<BlockCoord, CoordHash> seen;
  std::vector<BlockWindows> windows;
  for (const BrickCoord brick : changed) {
    const BlockCoord block{brick.x >> 1, brick.y >> 1, brick.z >> 1};
    if (!seen.insert(block).second) continue;
    std::optional<BlockWindows> found = gather_windows(field, box_of(block));
    if (found && !found->mesh(FaceEdges::sharp).empty()) windows.push_back(std::move(*found));
  }
  return windows;
}

/// The other polygoniser on the same blocks, in triangles: its polygons are no quads.
void report_cubes(BenchReport& report, const std::vector<BlockWindows>& dirty, int rounds, double nets_us,
                  size_t nets_triangles) {
  size_t triangles = 0;
  const double cubes_us = median_us(rounds, dirty.size(), [&] {
    triangles = 0;
    for (const BlockWindows& windows : dirty) triangles += windows.mesh_by_cubes(nullptr).indices.size() / 3;
  });
  const auto report_one = [&](const char* name, double block_us, size_t count) {
    const double per_block = static_cast<double>(count) / static_cast<double>(dirty.size());
    report.metric(fmt::format("{}_triangles_per_dirty_block", name), per_block);
    report.metric(fmt::format("{}_million_triangles_per_s", name), per_block / block_us);
  };
  report_one("nets", nets_us, nets_triangles);
  report_one("cubes", cubes_us, triangles);
  report.metric("cubes_dirty_block_us", cubes_us);
}

void report_blocks(BenchReport& report, Field& field, const std::vector<BrickCoord>& changed, int rounds) {
  const std::vector<BlockWindows> dirty = dirty_windows(field, changed);
  size_t triangles = 0;
  const double dirty_us = median_us(rounds, dirty.size(), [&] {
    triangles = 0;
    for (const BlockWindows& windows : dirty) triangles += windows.mesh(FaceEdges::sharp).indices.size() / 3;
  });
  report_cubes(report, dirty, rounds, dirty_us, triangles);
  // Nothing but air or nothing but rock, as far as anyone has looked: told by the bricks themselves.
  std::vector<BlockCoord> empty;
  for (const BlockCoord block : scene_blocks())
    if (!gather_windows(field, box_of(block))) empty.push_back(block);
  size_t surfaces = 0;
  const double empty_us = median_us(rounds, empty.size(), [&] {
    for (const BlockCoord block : empty) surfaces += gather_windows(field, box_of(block)) ? 1 : 0;
  });
  // And one whose codes must be looked at.
  const Window air(box_of({0, 0, 0}).grown(surface_nets_apron), code_air);
  constexpr size_t air_calls = 1000;
  const double air_us = median_us(rounds, air_calls, [&] {
    for (size_t i = 0; i < air_calls; ++i) surfaces += surface_nets(air, box_of({0, 0, 0})).indices.size();
  });
  const double gather_us = median_us(rounds, dirty.size(), [&] {
    for (const BlockWindows& windows : dirty) surfaces += gather_windows(field, windows.owned) ? 0 : 1;
  });
  report.check("counted", surfaces == 0 && triangles > 0, "surfaces only where there are some");
  report.metric("dirty_blocks", static_cast<double>(dirty.size()));
  report.metric("quads_per_dirty_block",
                static_cast<double>(triangles) / 2.0 / static_cast<double>(dirty.size()));
  report.metric("dirty_block_us", dirty_us);
  report.metric("dirty_block_gather_us", gather_us);
  report.metric("empty_block_us", empty_us);
  report.metric("block_of_air_codes_us", air_us);
  report.check("dirty_block", dirty_us <= 25.0,
               fmt::format("{:.1f} us a block, wanted at most 25", dirty_us));
  report.check(
      "empty_block", std::max(empty_us, air_us) <= 2.0,
      fmt::format("{:.2f} us told by its bricks, {:.2f} by its codes, wanted at most 2", empty_us, air_us));
}

/// All of the scene by one thread, with the copying out of the field, beside volumeToMesh by one thread.
void report_quads(BenchReport& report, Field& field, int rounds) {
  const std::vector<BlockCoord> blocks = scene_blocks();
  const peers::StockMesher stock(field, scene_box);
  size_t ours = 0, theirs = 0;
  std::vector<double> our_ms, mesh_ms, their_ms;
  for (int i = 0; i < rounds; ++i) {
    Stopwatch whole;
    ours = 0;
    double meshing_ms = 0.0;
    for (const BlockCoord block : blocks) {
      const std::optional<BlockWindows> windows = gather_windows(field, box_of(block));
      if (!windows) continue;
      Stopwatch stopwatch;
      ours += windows->mesh(FaceEdges::sharp).indices.size() / 6;
      meshing_ms += stopwatch.lap_ms();
    }
    our_ms.push_back(whole.lap_ms());
    mesh_ms.push_back(meshing_ms);
    theirs = stock.mesh();
    their_ms.push_back(whole.lap_ms());
  }
  const double ours_rate = static_cast<double>(ours) / quantile(our_ms, 0.5) / 1000.0;
  const double mesh_rate = static_cast<double>(ours) / quantile(mesh_ms, 0.5) / 1000.0;
  const double their_rate = static_cast<double>(theirs) / quantile(their_ms, 0.5) / 1000.0;
  report.metric("scene_quads", static_cast<double>(ours));
  report.metric("openvdb_scene_quads", static_cast<double>(theirs));
  report.metric("million_quads_per_s", mesh_rate);
  report.metric("with_gathering_million_quads_per_s", ours_rate);
  report.metric("openvdb_million_quads_per_s", their_rate);
  report.check(
      "times_openvdb", mesh_rate >= 5.0 * their_rate,
      fmt::format("{:.1f} million quads a second and thread against {:.1f}: {:.1f} times ({:.1f} with "
                  "copying out of the field), wanted 5",
                  mesh_rate, their_rate, mesh_rate / their_rate, ours_rate / their_rate));
}

/// From a mirror's change to the frame that shows it: meshing on the pool, upload included.
void report_delay(BenchReport& report, int carves) {
  constexpr float view_radius_m = 48.0F;
  const Result<std::unique_ptr<Stage>> stage = stage_of(report, view_radius_m);
  if (!stage) return report.check("delta_to_visible", false, stage.error().message);
  const Result<std::unique_ptr<DrawMethod>> method =
      method_named("mesh")->make((*stage)->pool, view_radius_m);
  if (!method) return report.check("delta_to_visible", false, method.error().message);
  MapField field(terrain);
  ScenePieces none;
  Camera camera;
  camera.eye_m = {8.0F, 8.0F, 0.0F};
  const auto finish = [&] {
    do (*method)->update(Scene{field, none}, camera);
    while (!(*method)->complete());
  };
  finish();
  ScatteredBlows blows(terrain, 24.0F, 2.0F, 1, 9);
  std::vector<double> times_ms;
  for (int i = 0; i < carves; ++i) {
    const CarveRequest blow = blows.next();
    PieceTable pieces;
    const Applied applied =
        apply(CarveOperation{blow.shape, blow.pattern, blow.seeds, blow.random_seed, blow.impact_m, 1}, field,
              pieces);
    Stopwatch stopwatch;
    MirrorChanges changes;
    changes.bricks = applied.changed;
    (*method)->changed(changes);
    finish();
    times_ms.push_back(stopwatch.lap_ms());
  }
  report.metric("delta_to_visible_median_ms", quantile(times_ms, 0.5));
  report.metric("delta_to_visible_p99_ms", quantile(times_ms, 0.99));
}

}  // namespace

BenchReport run_mesh_bench(const BenchOptions& options) {
  const int rounds = options.quick ? 3 : 25;
  BenchReport report;
  MapField field(terrain);
  const std::vector<BrickCoord> changed = carve_scene(field);
  options.progress(0.2);
  report_blocks(report, field, changed, rounds);
  options.progress(0.5);
  report_quads(report, field, options.quick ? 1 : 7);
  options.progress(0.8);
  report_delay(report, options.quick ? 5 : 50);
  options.progress(1.0);
  return report;
}

}  // namespace scree
