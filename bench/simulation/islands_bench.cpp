#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "bench/peers/segment_sdf.h"
#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "server/field/vdb_field.h"
#include "server/world/limits.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "shared/falling/island_search.h"
#include "tools/scenes/structures.h"

namespace scree {

namespace {

const TerrainSource terrain{TerrainKind::noise, 5, 0.25F};
constexpr float near_half_m = 32.0F;  ///< the 64 m world, and the scene in the middle of the other
constexpr float far_half_m = 512.0F;  ///< the 1,024 m world
constexpr float level_enough_m = 1.5F;
constexpr int rounds_a_peer_search = 10;

/// An edited field, and everything that the scene does to it.
struct Scene {
  VdbField field{terrain};
  PieceTable pieces;
  PieceId next_piece = 1;

  Applied apply(const Operation& operation) {
    Applied applied = scree::apply(operation, field, pieces);
    next_piece += static_cast<PieceId>(applied.created.size());
    return applied;
  }
  Applied carve(const Shape& shape, uint32_t seeds) {
    return apply(
        CarveOperation{shape, SeedPattern::uniform, seeds, next_piece, centre_of(shape), next_piece});
  }
  /// Blows all over a square; their pieces are of no interest here.
  void spread_edits(float half_width_m, int count, uint64_t random_seed) {
    ScatteredBlows blows(terrain, half_width_m, 2.0F, 1, random_seed);
    for (int i = 0; i < count; ++i) carve(blows.next().shape, 1);
    pieces.clear();
  }
};

float ground_m(float x_m, float z_m) {
  return ground_height_m(terrain, x_m, z_m);
}

constexpr float span_m = 8.0F;

/// Where an arch stands; a tower stands at its left foot.
struct Spot {
  glm::vec3 left_m;
  glm::vec3 right_m;
};

/// Whether all ground that the arch could touch lies lower than the cut through its feet.
bool is_level(const Spot& spot) {
  const float low_m = std::min(spot.left_m.y, spot.right_m.y);
  for (float x = spot.left_m.x - 3.0F; x <= spot.right_m.x + 3.0F; x += 1.0F)
    for (float z = spot.left_m.z - 3.0F; z <= spot.left_m.z + 3.0F; z += 1.0F)
      if (ground_m(x, z) > low_m + level_enough_m) return false;
  return true;
}

/// Whether the ground there is held up: noise makes a few rocks that hang in the air from the start.
bool holds(Scene& scene, glm::vec3 ground) {
  const glm::vec3 voxel = ground / terrain.voxel_size_m;
  const BrickCoord brick =
      brick_of(VoxelCoord{floor_to_int(voxel.x), floor_to_int(voxel.y) - 1, floor_to_int(voxel.z)});
  IslandSearch search(scene.field, {&brick, 1});
  size_t budget = 1U << 20U;
  return search.advance(budget) && search.islands().empty();
}

Spot next_spot(Scene& scene, Random& random) {
  for (;;) {
    const float reach_m = near_half_m - span_m;
    const float x = (random.unit() * 2.0F - 1.0F) * reach_m, z = (random.unit() * 2.0F - 1.0F) * reach_m;
    const Spot spot{{x, ground_m(x, z), z}, {x + span_m, ground_m(x + span_m, z), z}};
    if (is_level(spot) && holds(scene, spot.left_m) && holds(scene, spot.right_m)) return spot;
  }
}

/// One search, as the tick of the cut makes it.
struct Search {
  double milliseconds = 0.0;
  bool in_time = false;
  size_t bricks = 0;
  std::vector<Island> islands;

  Search(Scene& scene, const Applied& cut) {
    Stopwatch stopwatch;
    IslandSearch search(scene.field, cut.changed);
    size_t budget = limits::island_bricks_per_tick_min;
    in_time = search.advance(budget);
    if (in_time) islands = search.islands();
    milliseconds = stopwatch.lap_ms();
    bricks = search.read();
  }
};

struct Samples {
  std::vector<double> first_ms, find_ms, lift_ms;
  size_t carves = 0, found = 0, late = 0, bricks = 0;

  /// The search changes nothing: the best of three is its own time, the first one's also the cache's and the
  /// machine's.
  void measure_carve(Scene& scene, const Applied& applied, size_t expected) {
    const Search search(scene, applied);
    const double second_ms = Search(scene, applied).milliseconds;
    const double third_ms = Search(scene, applied).milliseconds;
    first_ms.push_back(search.milliseconds);
    find_ms.push_back(std::min({search.milliseconds, second_ms, third_ms}));
    bricks += search.bricks;
    late += search.in_time ? 0 : 1;
    ++carves;
    size_t large = 0;
    for (const Island& island : search.islands) large += island.voxels > 1000 ? 1 : 0;
    found += large == expected ? 1 : 0;
    Stopwatch stopwatch;
    for (const Island& island : search.islands)
      scene.apply(IslandOperation{island.box, island.start, scene.next_piece});
    if (!search.islands.empty()) lift_ms.push_back(stopwatch.lap_ms());
    scene.pieces.clear();
  }
};

/// The terrain about an arch, as it was before. It is generated at its first touch: a viewer or an earlier
/// blow has usually been there.
Window around(Scene& scene, const Spot& spot) {
  const Shape near = box(0.5F * (spot.left_m + spot.right_m), {12.0F, 24.0F, 8.0F});
  return gather(scene.field, band_box(in_voxels(near, terrain.voxel_size_m)));
}

void topple_tower(Scene& scene, const Spot& spot, Samples& samples) {
  const Window before = around(scene, spot);
  scene.apply(FillOperation{post_at(spot.left_m)});
  samples.measure_carve(scene, scene.carve(foot_of_post(spot.left_m), 8), 1);
  scatter(scene.field, before);
}

void drop_arch(Scene& scene, const Spot& spot, Samples& samples) {
  const Window before = around(scene, spot);
  for (const glm::vec3 side : {spot.left_m, spot.right_m}) scene.apply(FillOperation{post_at(side)});
  scene.apply(FillOperation{beam_between(spot.left_m, spot.right_m)});
  samples.measure_carve(scene, scene.carve(foot_of_post(spot.left_m), 8), 0);
  samples.measure_carve(scene, scene.carve(foot_of_post(spot.right_m), 8), 1);
  scatter(scene.field, before);
}

void report_world(BenchReport& report, const char* world, const char* what, const Samples& samples) {
  const auto put = [&](const char* step, const std::vector<double>& ms) {
    report.metric(fmt::format("{}_{}_{}_median_ms", world, what, step), quantile(ms, 0.5));
    report.metric(fmt::format("{}_{}_{}_p99_ms", world, what, step), quantile(ms, 0.99));
  };
  put("first_find", samples.first_ms);
  put("find", samples.find_ms);
  put("lift", samples.lift_ms);
  report.metric(fmt::format("{}_{}_bricks_mean", world, what),
                static_cast<double>(samples.bricks) / static_cast<double>(samples.carves));
  report.check(fmt::format("{}_{}_found", world, what), samples.found == samples.carves && samples.late == 0,
               fmt::format("{} of {} cuts found right, {} after their tick", samples.found, samples.carves,
                           samples.late));
  const double p99 = quantile(samples.find_ms, 0.99);
  report.check(fmt::format("{}_{}_p99", world, what), p99 <= 2.0, fmt::format("{:.2f} ms, wanted 2", p99));
}

void report_ratio(BenchReport& report, const char* what, const Samples& near, const Samples& far) {
  const double ratio = quantile(far.find_ms, 0.5) / quantile(near.find_ms, 0.5);
  report.metric(fmt::format("{}_find_1024_m_to_64_m", what), ratio);
  report.check(fmt::format("{}_find_is_local", what), ratio <= 1.1,
               fmt::format("{:.3f} times the 64 m world's, wanted at most 1.1", ratio));
}

/// OpenVDB's own search in all of the 64 m world, of which every call is the same work.
struct Peer {
  std::vector<double> milliseconds;
  PeerSegments segments;

  void segment(Scene& scene) {
    const int half = static_cast<int>(near_half_m / terrain.voxel_size_m), height = 96;
    segments = segment_with_openvdb(scene.field, {{-half, -height, -half}, {half, height, half}});
    milliseconds.push_back(segments.milliseconds);
  }
};

void report_peer(BenchReport& report, const Peer& peer, const Samples& tower) {
  const double peer_ms = quantile(peer.milliseconds, 0.5), own_ms = quantile(tower.find_ms, 0.5);
  report.metric("peer_segment_sdf_median_ms", peer_ms);
  report.metric("peer_leaves", static_cast<double>(peer.segments.leaves));
  report.metric("peer_segments", static_cast<double>(peer.segments.segments));
  report.metric("peer_to_own", peer_ms / own_ms);
  report.check("faster_than_segment_sdf", peer_ms >= 50.0 * own_ms,
               fmt::format("{:.0f} times as fast, wanted 50", peer_ms / own_ms));
}

}  // namespace

BenchReport run_islands_bench(const BenchOptions& options) {
  const int edits = options.quick ? 16 : 128, rounds = options.quick ? 10 : 200;
  Scene near, far;
  near.spread_edits(near_half_m, edits, 1);
  far.spread_edits(near_half_m, edits, 1);
  far.spread_edits(far_half_m, 4 * edits, 2);
  Samples near_tower, far_tower, near_arch, far_arch;
  Peer peer;
  Random random(9);
  for (int i = 0; i < rounds; ++i) {
    // In turn, each first every other time, so that both see the same machine.
    const Spot spot = next_spot(near, random), other = next_spot(near, random);
    for (const bool is_near : {i % 2 == 0, i % 2 != 0}) {
      topple_tower(is_near ? near : far, spot, is_near ? near_tower : far_tower);
      drop_arch(is_near ? near : far, other, is_near ? near_arch : far_arch);
    }
    if ((i + 1) % rounds_a_peer_search == 0) peer.segment(near);
    options.progress(static_cast<double>(i + 1) / rounds);
  }
  BenchReport report;
  report_world(report, "64_m", "tower", near_tower);
  report_world(report, "64_m", "arch", near_arch);
  report_world(report, "1024_m", "tower", far_tower);
  report_world(report, "1024_m", "arch", far_arch);
  report_ratio(report, "tower", near_tower, far_tower);
  report_ratio(report, "arch", near_arch, far_arch);
  report_peer(report, peer, near_tower);
  return report;
}

}  // namespace scree
