#include <cmath>
#include <fmt/format.h>

#include "bench/benches.h"
#include "bench/scenes.h"

namespace scree {

namespace {

constexpr int ticks_between_carves = 30;
constexpr int ticks_to_settle_max = 3600;

/// Steps until no piece is alive; returns whether that came to be.
bool settle(World& world) {
  for (int i = 0; i < ticks_to_settle_max; ++i)
    if (world.step({})->pieces.empty()) return true;
  return false;
}

}  // namespace

BenchReport run_ledger_bench(const BenchOptions& options) {
  const int carves = options.quick ? 50 : 1000;
  WorldConfig config;
  World world(config);
  ScatteredBlows blows(config.terrain, 60.0F, 1.0F, 12, 1);
  MassUnits worst_error = 0;
  uint64_t made = 0, refused = 0;
  Ledger ledger;
  for (int i = 0; i < carves; ++i) {
    const Command command{0, static_cast<uint32_t>(i), blows.next()};
    auto delta = world.step({&command, 1});
    made += delta->spawned.size();
    refused += delta->replies.front().refusal.empty() ? 0 : 1;
    for (int tick = 0; tick < ticks_between_carves; ++tick) {
      delta = world.step({});
      worst_error = std::max(worst_error, std::abs(delta->ledger.error()));
    }
    ledger = delta->ledger;
    options.progress(static_cast<double>(i + 1) / carves);
  }
  const bool settled = settle(world);
  ledger = world.step({})->ledger;
  const MassUnits drift = world.measure_terrain() - ledger.terrain;
  const auto moved = static_cast<double>(ledger.moved);
  const auto percent = [moved](MassUnits units) {
    return 100.0 * std::abs(static_cast<double>(units)) / moved;
  };

  BenchReport report;
  report.metric("carves", carves);
  report.metric("refused", static_cast<double>(refused));
  report.metric("pieces_made", static_cast<double>(made));
  report.metric("moved_voxels", moved / units_per_voxel);
  report.metric("dust_voxels", static_cast<double>(ledger.dust) / units_per_voxel);
  report.metric("ledger_error_percent", percent(worst_error));
  report.metric("measured_drift_percent", percent(drift));
  report.check("ledger_error", percent(worst_error) <= 0.1,
               fmt::format("{:.6f} % of the mass moved, wanted at most 0.1 %", percent(worst_error)));
  report.check("terrain_measured_afresh", drift == 0,
               fmt::format("{} units off the ledger, wanted 0", drift));
  report.check("settled", settled, settled ? "no piece left" : "pieces were still alive after a minute");
  return report;
}

}  // namespace scree
