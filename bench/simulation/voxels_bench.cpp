#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <vector>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "proto/codec.h"
#include "server/formats/world_codec.h"
#include "server/world/world.h"
#include "shared/base/quantile.h"

namespace scree {

namespace {

constexpr float voxel_sizes_m[] = {0.25F, 0.15F, 0.1F};

constexpr float edit_radius_m = 2.0F, edits_apart_m = 8.0F;
constexpr uint32_t edit_seeds = 64;
constexpr int rest_ticks_at_most = 900;

/// The same edits in voxels of one size.
class EditedWorld {
 public:
  EditedWorld(float size_m, uint32_t edits_a_side)
      : world_(config_of(size_m)),
        edits_(world_.config().terrain, edits_a_side, edits_apart_m, edit_radius_m, edit_seeds) {
    empty_bytes_ = encode(world_.snapshot()).size();
  }

  /// The next edit, until its pieces have merged. False: there is none.
  bool edit() {
    std::optional<CarveRequest> next = edits_.next();
    if (!next) return false;
    next->shape.kind = ShapeKind::crater;
    const float size_m = world_.config().terrain.voxel_size_m;
    // As a server does ahead of its ticks (server/app/terrain_ahead.h).
    gather(world_.field(), band_box(in_voxels(next->shape, size_m)).grown(chunk_size));
    const Command command{0, ++count_, *next};
    double carve_ms = 0.0, merge_ms = 0.0, worst_ms = 0.0;
    for (int tick = 0; tick < rest_ticks_at_most; ++tick) {
      last_ = tick == 0 ? world_.step({&command, 1}) : world_.step({});
      for (const TickStage stage : {TickStage::requests, TickStage::refracture, TickStage::spawn})
        carve_ms += last_->times[stage];
      merge_ms += last_->times[TickStage::recombine];
      worst_ms = std::max(worst_ms, last_->times.total_ms());
      FrameMessage frame;
      for (const AppliedOperation& applied : last_->operations) frame.operations.push_back(applied.operation);
      if (!frame.operations.empty()) operation_bytes_ += encode(ServerMessage{frame}).size();
      pieces_ += last_->spawned.size();
      error_ = std::max(error_, std::abs(last_->ledger.error()));
      if (tick > 0 && last_->pieces.empty() && last_->work.refractures_put_off == 0) break;
    }
    carve_ms_.push_back(carve_ms);
    merge_ms_.push_back(merge_ms);
    worst_ms_.push_back(worst_ms);
    return true;
  }
  void tell(BenchReport& report) {
    const std::string name = fmt::format("{:.2f}_m_", world_.config().terrain.voxel_size_m);
    const auto an_edit = [&](double sum) { return sum / static_cast<double>(count_); };
    report.metric(name + "carve_median_ms", quantile(carve_ms_, 0.5));
    report.metric(name + "merge_median_ms", quantile(merge_ms_, 0.5));
    report.metric(name + "worst_tick_median_ms", quantile(worst_ms_, 0.5));
    report.metric(name + "pieces_an_edit", an_edit(static_cast<double>(pieces_)));
    report.metric(name + "bricks_an_edit_kib",
                  an_edit(static_cast<double>(world_.field().edited_brick_count() * sizeof(Brick))) / 1024.0);
    report.metric(name + "kept_an_edit_kib",
                  an_edit(static_cast<double>(encode(world_.snapshot()).size() - empty_bytes_)) / 1024.0);
    report.metric(name + "operations_an_edit_kib", an_edit(static_cast<double>(operation_bytes_)) / 1024.0);
    report.check(name + "ledger", error_ == 0 && world_.measure_terrain() == last_->ledger.terrain,
                 fmt::format("error {}, {} pieces left", error_, last_->pieces.size()));
  }

 private:
  static WorldConfig config_of(float size_m) {
    WorldConfig config;
    config.terrain = {TerrainKind::noise, 5, size_m};
    return config;
  }

  World world_;
  BlowGrid edits_;
  size_t empty_bytes_ = 0, operation_bytes_ = 0, pieces_ = 0;
  uint32_t count_ = 0;
  MassUnits error_ = 0;
  std::vector<double> carve_ms_, merge_ms_, worst_ms_;
  std::shared_ptr<const TickDelta> last_;
};

}  // namespace

BenchReport run_voxels_bench(const BenchOptions& options) {
  const uint32_t side = options.quick ? 2 : 5;
  std::vector<std::unique_ptr<EditedWorld>> worlds;
  for (const float size_m : voxel_sizes_m) worlds.push_back(std::make_unique<EditedWorld>(size_m, side));
  // In turns, so that all see the same machine.
  for (uint32_t done = 0; done < side * side; ++done) {
    for (const auto& world : worlds) world->edit();
    options.progress(static_cast<double>(done + 1) / (side * side));
  }
  BenchReport report;
  report.metric("edits", side * side);
  for (const auto& world : worlds) world->tell(report);
  return report;
}

}  // namespace scree
