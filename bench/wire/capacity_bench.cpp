#include <algorithm>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/wire/crowd.h"

namespace scree {

namespace {

constexpr double reply_max_ms = 1000.0;
constexpr double ticks_per_s_min = 59.0;
constexpr size_t bots_wanted = 20;

/// A bot that carves 2 m into 64 pieces once a second.
BotConfig honest() {
  BotConfig bot;
  bot.rate_hz = 1.0;
  bot.interest_radius_m = 48.0F;
  bot.carver.radius_m = 2.0F;
  bot.carver.seeds = 64;
  return bot;
}

struct Level {
  size_t bots = 0;
  double seconds = 0.0;
  double accepted = 0.0;  ///< share of the carves that were answered
  double reply_p99_ms = 0.0;
  double ticks_per_s = 0.0;
  double tick_p99_ms = 0.0;
  double pieces_a_carve = 0.0;
  double carves_per_s = 0.0;
  bool holds = false;
};

Level measure(const CrowdOutcome& outcome, double seconds) {
  Level level{.bots = outcome.bots.size(), .seconds = seconds};
  uint32_t accepted = 0, refused = 0;
  std::vector<double> replies_ms;
  for (const BotReport& bot : outcome.bots) {
    accepted += bot.carves_accepted;
    refused += bot.carves_refused;
    replies_ms.insert(replies_ms.end(), bot.reply_latencies_ms.begin(), bot.reply_latencies_ms.end());
    level.holds = level.holds || !bot.failure.empty();
  }
  const bool failed = level.holds;
  level.accepted = static_cast<double>(accepted) / std::max(1.0, static_cast<double>(accepted + refused));
  level.reply_p99_ms = quantile(replies_ms, 0.99);
  level.ticks_per_s = outcome.ticks_per_s;
  level.tick_p99_ms = outcome.server.tick.quantile_ms(0.99);
  level.pieces_a_carve =
      static_cast<double>(outcome.server.pieces_made) / std::max(1.0, static_cast<double>(accepted));
  level.carves_per_s = static_cast<double>(accepted) / seconds;
  level.holds =
      !failed && refused == 0 && level.reply_p99_ms <= reply_max_ms && level.ticks_per_s >= ticks_per_s_min;
  return level;
}

void report_level(BenchReport& report, const Level& level) {
  const std::string name = fmt::format("bots_{}", level.bots);
  report.metric(name + "_accepted_percent", 100.0 * level.accepted);
  report.metric(name + "_carves_per_s", level.carves_per_s);
  report.metric(name + "_pieces_a_carve", level.pieces_a_carve);
  report.metric(name + "_reply_p99_ms", level.reply_p99_ms);
  report.metric(name + "_ticks_per_s", level.ticks_per_s);
  report.metric(name + "_tick_p99_ms", level.tick_p99_ms);
}

}  // namespace

BenchReport run_capacity_bench(const BenchOptions& options) {
  BenchReport report;
  const double seconds = options.quick ? 5.0 : 20.0;
  const std::vector<size_t> counts =
      options.quick ? std::vector<size_t>{2, 5} : std::vector<size_t>{5, 10, 20, 30, 40};
  size_t most = 0;
  double best_per_s = 0.0, last_per_s = 0.0;
  bool held = true;
  for (size_t i = 0; i < counts.size(); ++i) {
    const Result<CrowdOutcome> outcome = play({}, bots_on_a_grid(counts[i], 50.0F, honest()), seconds);
    if (!outcome) {
      report.check("server_starts", false, outcome.error().message);
      return report;
    }
    const Level level = measure(*outcome, seconds);
    report_level(report, level);
    held = held && level.holds;
    if (held) most = counts[i];
    best_per_s = std::max(best_per_s, level.carves_per_s);
    last_per_s = level.carves_per_s;
    options.progress(static_cast<double>(i + 1) / static_cast<double>(counts.size()));
  }
  report.metric("capacity_bots", static_cast<double>(most));
  report.check("capacity", options.quick || most >= bots_wanted,
               fmt::format("{} bots, wanted {}", most, bots_wanted));
  report.check("beyond_it_no_less_goes_through", last_per_s >= 0.9 * best_per_s,
               fmt::format("{:.1f} carves a second with most bots, {:.1f} at best", last_per_s, best_per_s));
  return report;
}

}  // namespace scree
