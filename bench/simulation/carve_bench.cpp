#include <fmt/format.h>
#include <functional>

#include "bench/peers/stock_fracture.h"
#include "bench/support/benches.h"
#include "bench/support/scene_blows.h"
#include "bench/support/scenes.h"
#include "bench/support/stage_times.h"

namespace scree {

namespace {

constexpr int ticks_between_carves = 240;
constexpr int own_blows_a_stock_blow = 10;

constexpr float blow_radius_m = 2.0F;
constexpr uint32_t blow_seeds = 64;
constexpr float blow_half_width_m = 50.0F;

/// Blows of the bench, the same at each call: about the strikes of a scene, or scattered over its own ground.
std::function<CarveRequest()> blows_of(const BenchOptions& options) {
  if (options.scene != nullptr)
    return [blows = SceneBlows(*options.scene, blow_radius_m, blow_seeds, 11)]() mutable {
      return blows.next();
    };
  return [blows = ScatteredBlows(WorldConfig().terrain, blow_half_width_m, blow_radius_m, blow_seeds,
                                 11)]() mutable { return blows.next(); };
}

/// Blows until a scene's terrain about its strikes is not what it was, and is made anew.
size_t blows_a_world(const BenchOptions& options) {
  return options.scene != nullptr ? options.scene->strikes.size() : SIZE_MAX;
}

/// 64 m of terrain about a blow.
VoxelBox stock_box(const CarveRequest& blow, float voxel_size_m) {
  const VoxelBox box{{-128, -64, -128}, {128, 128, 128}};
  const glm::vec3 centre = blow.shape.a / voxel_size_m;
  const VoxelCoord middle{floor_to_int(centre.x), floor_to_int(centre.y), floor_to_int(centre.z)};
  return {box.lo + middle, box.hi + middle};
}

/// OpenVDB's stock way with the first of the same blows, each in 64 m of fresh terrain and by the seeds that
/// Scree has there.
class StockBlows {
 public:
  StockBlows(const BenchOptions& options, const WorldConfig& config)
      : options_(options), terrain_(config.terrain), next_blow_(blows_of(options)) {}

  void strike() {
    const CarveRequest blow = next_blow_();
    MapField field(terrain_);
    if (options_.scene != nullptr) build_scene(field, *options_.scene);
    PieceTable pieces;
    peers::StockTerrain stock(field, stock_box(blow, terrain_.voxel_size_m));
    const Applied applied = apply(CarveOperation{.shape = blow.shape,
                                                 .pattern = blow.pattern,
                                                 .seeds = blow.seeds,
                                                 .random_seed = blow.random_seed,
                                                 .impact_m = blow.impact_m,
                                                 .first_piece = 1},
                                  field, pieces);
    std::vector<glm::vec3> seeds_m;
    for (const glm::vec3& seed : applied.seeds_voxels) seeds_m.push_back(seed * terrain_.voxel_size_m);
    times_ms_.push_back(stock.carve(blow.shape.a, blow.shape.radius_m, seeds_m).total_ms());
  }
  size_t count() const { return times_ms_.size(); }
  double median_ms() const { return quantile(times_ms_, 0.5); }

 private:
  const BenchOptions& options_;
  TerrainSource terrain_;
  std::function<CarveRequest()> next_blow_;
  std::vector<double> times_ms_;
};

struct Carved {
  std::vector<StageTimes> carving;
  std::vector<StageTimes> others;
  std::vector<double> own_ms;
  size_t pieces = 0;
};

/// Blows by that shape, one after another in a world that keeps their craters.
Carved carve_all(const BenchOptions& options, const WorldConfig& config, ShapeKind shape, int carves,
                 const std::function<void(int)>& done) {
  std::unique_ptr<World> world;
  const auto next_blow = blows_of(options);
  Carved carved;
  for (int i = 0; i < carves; ++i) {
    if (static_cast<size_t>(i) % blows_a_world(options) == 0) world = world_of(options, config);
    CarveRequest blow = next_blow();
    blow.shape.kind = shape;
    // As a server does ahead of its ticks, around clients' eyes (server/app/terrain_ahead.h).
    gather(world->field(), band_box(in_voxels(blow.shape, config.terrain.voxel_size_m)).grown(chunk_size));
    const Command command{0, static_cast<uint32_t>(i), blow};
    const auto delta = world->step({&command, 1});
    carved.carving.push_back(delta->times);
    carved.own_ms.push_back(delta->times[TickStage::requests] + delta->times[TickStage::spawn]);
    carved.pieces += delta->spawned.size();
    for (int tick = 1; tick < ticks_between_carves; ++tick) carved.others.push_back(world->step({})->times);
    done(i + 1);
  }
  return carved;
}

}  // namespace

BenchReport run_carve_bench(const BenchOptions& options) {
  const int carves = options.quick ? 10 : 100;
  const WorldConfig config = config_of(options, {});
  StockBlows stock(options, config);
  // In turns, so that both see the same machine.
  const auto progress = [&](int done) {
    if (done % own_blows_a_stock_blow == 0) stock.strike();
    options.progress(static_cast<double>(done) / (2 * carves));
  };
  const auto [carving, others, own_ms, pieces] =
      carve_all(options, config, ShapeKind::sphere, carves, progress);
  const Carved craters =
      carve_all(options, config, ShapeKind::crater, carves, [&](int done) { progress(carves + done); });
  BenchReport report;
  report.metric("carves", carves);
  report.metric("pieces_per_carve", static_cast<double>(pieces) / carves);
  report_stages(report, "carve_tick", carving);
  report_stages(report, "other_tick", others);
  const double own_p99_ms = quantile(own_ms, 0.99);
  report.metric("own_work_median_ms", quantile(own_ms, 0.5));
  report.metric("own_work_p99_ms", own_p99_ms);
  report.check(
      "own_work_p99", own_p99_ms <= 4.0,
      fmt::format("{:.2f} ms for carve, extract, fracture and hulls, wanted at most 4 ms", own_p99_ms));
  const double own_ms_median = quantile(own_ms, 0.5), stock_ms = stock.median_ms();
  report.metric("openvdb_carves", static_cast<double>(stock.count()));
  report.metric("openvdb_median_ms", stock_ms);
  report.check("times_faster", stock_ms >= 60.0 * own_ms_median,
               fmt::format("{:.2f} ms, median of {} blows in one world, against {:.1f}, of the first {} of "
                           "them, each in fresh terrain: {:.0f} times, wanted 60",
                           own_ms_median, carves, stock_ms, stock.count(), stock_ms / own_ms_median));
  const double crater_ms = quantile(craters.own_ms, 0.5);
  report.metric("crater_own_work_median_ms", crater_ms);
  report.metric("crater_pieces_per_carve", static_cast<double>(craters.pieces) / carves);
  report.check("crater_times_faster", stock_ms >= 40.0 * crater_ms,
               fmt::format("{:.2f} ms against {:.1f} for a smooth ball: {:.0f} times, wanted 40", crater_ms,
                           stock_ms, stock_ms / crater_ms));
  if (options.scene != nullptr) return report;  // rock may be thin there
  // Cells under two voxels, near the impact, join a neighbour.
  report.check(
      "pieces", pieces * 100 >= static_cast<size_t>(carves) * 64 * 98,
      fmt::format("{} pieces of {} carves, wanted 64 each, less 2 % that join others", pieces, carves));
  return report;
}

}  // namespace scree
