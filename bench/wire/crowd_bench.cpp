#include <algorithm>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/wire/crowd.h"
#include "shared/base/limits.h"
#include "shared/base/memory_count.h"

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

void report_falls(BenchReport& report, const std::string& name, const CrowdOutcome& outcome) {
  const std::vector<double>& falls_s = outcome.falls_s;
  const double worst_s = falls_s.empty() ? 1e9 : *std::ranges::max_element(falls_s);
  report.metric(name + "_fall_worst_s", worst_s);
  report.metric(name + "_memory_mb", static_cast<double>(process_memory_bytes()) / 1e6);
  report.check(
      name + "_falls", falls_s.size() >= 2 && worst_s <= 1.0,
      fmt::format("{} towers fell, the slowest after {:.2f} s; wanted 1 s", falls_s.size(), worst_s));
  const uint64_t mismatches = outcome.bots.front().seen.mismatches;
  report.check(name + "_hashes", mismatches == 0, fmt::format("{} frames whose check failed", mismatches));
}

/// Plays, and reports by `name`. False: the server did not start, which is reported.
bool play_and_report(BenchReport& report, const std::string& name, std::vector<BotConfig> bots,
                     double seconds, const IntruderKind* intruder) {
  const Result<CrowdOutcome> outcome = play({}, std::move(bots), seconds, intruder);
  if (!outcome) {
    report.check("server_starts", false, outcome.error().message);
    return false;
  }
  report_crowd(report, name, *outcome);
  if (intruder != nullptr) report_falls(report, name, *outcome);
  return true;
}

}  // namespace

BenchReport run_crowd_bench(const BenchOptions& options) {
  BenchReport report;
  const double seconds = options.quick ? 5.0 : 20.0;
  const std::vector<size_t> crowds = options.quick ? std::vector<size_t>{1} : std::vector<size_t>{1, 20};
  const auto wanted = [&](const char* part) { return options.part.empty() || options.part == part; };
  const double all = static_cast<double>(crowds.size() * std::size(demands) + intruder_kinds().size());
  double done = 0.0;
  for (const size_t greedy : crowds)
    for (const Demand& demand : demands) {
      const std::string name = fmt::format("beside_{}_{}", greedy, demand.name);
      if (wanted("carves") && !play_and_report(report, name, bots_of(greedy, demand), seconds, nullptr))
        return report;
      options.progress(++done / all);
    }
  for (const IntruderKind& intruder : intruder_kinds()) {
    const std::string name = fmt::format("beside_{}", intruder.name);
    if (wanted(intruder.name) && !play_and_report(report, name, bots_of(0, demands[0]), seconds, &intruder))
      return report;
    options.progress(++done / all);
  }
  return report;
}

}  // namespace scree
