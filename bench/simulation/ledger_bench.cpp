#include <cmath>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"

namespace scree {

namespace {

constexpr int ticks_between_carves = 30;
/// Largest error of the ledger, and of the measured terrain, as a share of the mass moved.
constexpr double ledger_error_max = 1e-6;
constexpr double drift_max = 1e-3;
constexpr int ticks_to_settle_max = 3600;

/// Steps until no piece is alive; returns whether that came to be.
bool settle(World& world) {
  for (int i = 0; i < ticks_to_settle_max; ++i)
    if (world.step({})->pieces.empty()) return true;
  return false;
}

/// Counts of events besides the requested carves.
struct Events {
  uint64_t breaks = 0;
  uint64_t dents = 0;
  uint64_t islands = 0;

  /// `asked`: carves carried out in this tick because a request said so.
  void add(const TickDelta& delta, uint64_t asked) {
    uint64_t carves = 0;
    for (const AppliedOperation& applied : delta.operations) {
      breaks += std::holds_alternative<ShatterOperation>(applied.operation) ? 1 : 0;
      islands += std::holds_alternative<IslandOperation>(applied.operation) ? 1 : 0;
      carves += std::holds_alternative<CarveOperation>(applied.operation) ? 1 : 0;
    }
    dents += carves - asked;
  }
};

/// Every fourth blow makes few, large, fast pieces: those fly far, and strike hard.
CarveRequest next_blow(ScatteredBlows& blows, int number) {
  CarveRequest request = blows.next();
  if (number % 4 != 0) return request;
  request.shape.radius_m *= 1.6F;
  request.seeds = 4;
  request.blast_speed_m_s = 28.0F;
  return request;
}

}  // namespace

BenchReport run_ledger_bench(const BenchOptions& options) {
  const int carves = options.quick ? 50 : 1000;
  WorldConfig config;
  World world(config);
  ScatteredBlows blows(config.terrain, 60.0F, 1.0F, 12, 1);
  MassUnits worst_error = 0;
  uint64_t made = 0, refused = 0;
  Events events;
  Ledger ledger;
  for (int i = 0; i < carves; ++i) {
    const Command command{0, static_cast<uint32_t>(i), next_blow(blows, i)};
    auto delta = world.step({&command, 1});
    events.add(*delta, delta->replies.front().refusal.empty() ? 1 : 0);
    made += delta->spawned.size();
    refused += delta->replies.front().refusal.empty() ? 0 : 1;
    for (int tick = 0; tick < ticks_between_carves; ++tick) {
      delta = world.step({});
      events.add(*delta, 0);
      worst_error = std::max(worst_error, std::abs(delta->ledger.error()));
    }
    ledger = delta->ledger;
    options.progress(static_cast<double>(i + 1) / carves);
  }
  const bool settled = settle(world);
  ledger = world.step({})->ledger;
  const MassUnits drift = world.measure_terrain() - ledger.terrain;
  const auto moved = static_cast<double>(ledger.moved);
  const auto share = [moved](MassUnits units) { return std::abs(static_cast<double>(units)) / moved; };

  BenchReport report;
  report.metric("carves", carves);
  report.metric("refused", static_cast<double>(refused));
  report.metric("pieces_made", static_cast<double>(made));
  report.metric("moved_voxels", moved / units_per_voxel);
  report.metric("dust_voxels", static_cast<double>(ledger.dust) / units_per_voxel);
  report.metric("breaks", static_cast<double>(events.breaks));
  report.metric("dents", static_cast<double>(events.dents));
  report.metric("islands", static_cast<double>(events.islands));
  report.metric("ledger_error_share", share(worst_error));
  report.metric("measured_drift_share", share(drift));
  report.check("ledger_error", share(worst_error) <= ledger_error_max,
               fmt::format("{:.1e} of the mass moved at the worst tick, wanted at most {:.0e}",
                           share(worst_error), ledger_error_max));
  report.check("terrain_measured_afresh", share(drift) <= drift_max,
               fmt::format("{} units off the ledger, {:.1e} of the mass moved, wanted at most {:.0e}", drift,
                           share(drift), drift_max));
  report.check("impacts_and_dents", events.breaks > 0 && events.dents > 0,
               fmt::format("{} breaks and {} dents, wanted some of each", events.breaks, events.dents));
  report.check("settled", settled, settled ? "no piece left" : "pieces were still alive after a minute");
  return report;
}

}  // namespace scree
