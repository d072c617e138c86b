#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/wire/crowd.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

/// What a client that wants all of the server asks for.
struct Demand {
  const char* name;
  float radius_m;
  uint32_t seeds;
};

constexpr Demand demands[] = {
    {"largest", limits::edit_reach_max_m, limits::seeds_max},  // of largest size and most seeds: all refused
    {"large", limits::edit_reach_max_m, 64},
    {"many", 2.0F, 64},
};

std::vector<BotConfig> bots_of(size_t greedy, const Demand& demand) {
  BotConfig like;
  like.rate_hz = 30.0;
  like.interest_radius_m = 24.0F;  // they want to ask, not to watch: all clients share this machine's cores
  like.carver.radius_m = demand.radius_m;
  like.carver.seeds = demand.seeds;
  std::vector<BotConfig> bots = bots_on_a_grid(greedy + 1, 50.0F, like);
  bots.front().rate_hz = 2.0;
  bots.front().interest_radius_m = 48.0F;
  bots.front().carver.radius_m = 2.0F;
  bots.front().carver.seeds = 64;
  return bots;
}

void report_crowd(BenchReport& report, const std::string& name, const CrowdOutcome& outcome) {
  const BotReport& honest = outcome.bots.front();
  const double accepted = accepted_share(honest);
  const double reply_p99_ms = quantile(honest.reply_latencies_ms, 0.99);
  double greedy_accepted = 0.0;
  for (size_t i = 1; i < outcome.bots.size(); ++i) greedy_accepted += outcome.bots[i].carves_accepted;
  report.metric(name + "_honest_asked", honest.carves_asked);
  report.metric(name + "_honest_accepted_percent", 100.0 * accepted);
  report.metric(name + "_honest_reply_p99_ms", reply_p99_ms);
  report.metric(name + "_others_accepted", greedy_accepted);
  report.metric(name + "_ticks_per_s", outcome.ticks_per_s);
  report.metric(name + "_tick_p99_ms", outcome.server.tick.quantile_ms(0.99));
  std::string refused;
  for (const auto& [reason, count] : honest.refusals) refused += fmt::format(", {} by {}", count, reason);
  report.check(
      name,
      honest.failure.empty() && accepted >= 0.95 && reply_p99_ms <= 1000.0 && outcome.ticks_per_s >= 59.0,
      fmt::format("{:.0f} % accepted{}, reply p99 {:.0f} ms, {:.1f} ticks a second {}; wanted 95 %, "
                  "1,000 ms, 59 a second",
                  100.0 * accepted, refused, reply_p99_ms, outcome.ticks_per_s, honest.failure));
}

}  // namespace

BenchReport run_crowd_bench(const BenchOptions& options) {
  BenchReport report;
  const double seconds = options.quick ? 5.0 : 20.0;
  const std::vector<size_t> crowds = options.quick ? std::vector<size_t>{1} : std::vector<size_t>{1, 20};
  double done = 0.0;
  for (const size_t greedy : crowds)
    for (const Demand& demand : demands) {
      const Result<CrowdOutcome> outcome = play({}, bots_of(greedy, demand), seconds);
      if (!outcome) {
        report.check("server_starts", false, outcome.error().message);
        return report;
      }
      report_crowd(report, fmt::format("beside_{}_{}", greedy, demand.name), *outcome);
      options.progress(++done / static_cast<double>(crowds.size() * std::size(demands)));
    }
  return report;
}

}  // namespace scree
