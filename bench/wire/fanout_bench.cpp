// A storm seen by up to 3,000 viewers, all on this machine's cores: how old a frame is when a viewer has read
// it, from the moment in which the simulation handed it over.
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/wire/audience.h"

namespace scree {

namespace {

struct Crowd {
  size_t viewers;
  float spread_m;  ///< their eyes lie within this of the origin
  double wanted_p99_ms;
};

Result<void> run_crowd(const Crowd& crowd, double seconds, BenchReport& report) {
  const auto outcome = show_storm({.viewers = crowd.viewers, .spread_m = crowd.spread_m, .seconds = seconds});
  TRY(outcome);
  const AgeCount& ages = outcome->ages;
  const std::string name = fmt::format("{}_{}", crowd.viewers, crowd.spread_m > 0.0F ? "spread" : "together");
  const double p99_ms = ages.quantile_ms(0.99);
  report.metric(name + "_age_median_ms", ages.quantile_ms(0.5));
  report.metric(name + "_age_p99_ms", p99_ms);
  report.metric(name + "_age_worst_ms", ages.quantile_ms(1.0 - 1e-9));
  report.metric(name + "_frames", static_cast<double>(ages.count()));
  report.metric(name + "_kbit_s_a_viewer", outcome->kbit_s_a_viewer);
  report.metric(name + "_kib_a_viewer", outcome->kib_a_viewer);
  report.metric(name + "_late_ticks", static_cast<double>(outcome->late_ticks));
  report.metric(name + "_resets", static_cast<double>(outcome->resets));
  report.check(
      name,
      ages.count() > 0 && p99_ms <= crowd.wanted_p99_ms && outcome->late_ticks == 0 &&
          outcome->kib_a_viewer <= 64.0 && outcome->lost == 0 && outcome->failure.empty() &&
          outcome->checks > 0 && outcome->mismatches == 0,
      fmt::format("age p99 {:.1f} ms, {} of {} ticks late, {:.0f} KiB a viewer, {} lost, {} checks with {} "
                  "mismatches {}; wanted {:.0f} ms, none, 64 KiB, none, none",
                  p99_ms, outcome->late_ticks, outcome->ticks, outcome->kib_a_viewer, outcome->lost,
                  outcome->checks, outcome->mismatches, outcome->failure, crowd.wanted_p99_ms));
  return {};
}

}  // namespace

BenchReport run_fanout_bench(const BenchOptions& options) {
  BenchReport report;
  const std::vector<Crowd> crowds = options.quick ? std::vector<Crowd>{{100, 0.0F, 30.0}}
                                                  : std::vector<Crowd>{{100, 0.0F, 30.0},
                                                                       {1000, 0.0F, 30.0},
                                                                       {1000, 200.0F, 30.0},
                                                                       {3000, 0.0F, 100.0},
                                                                       {3000, 200.0F, 100.0}};
  double done = 0.0;
  for (const Crowd& crowd : crowds) {
    if (const auto ran = run_crowd(crowd, options.quick ? 2.0 : 12.0, report); !ran) {
      report.check(fmt::format("{}_viewers", crowd.viewers), false, ran.error().message);
      return report;
    }
    options.progress(++done / static_cast<double>(crowds.size()));
  }
  return report;
}

}  // namespace scree
