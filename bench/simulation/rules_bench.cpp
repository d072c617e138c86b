#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "bench/support/scratch.h"
#include "server/rules/api.h"
#include "server/rules/rules.h"
#include "server/work/limits.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr Tick rules_ticks = 900, ticks_between_storms = 3;
constexpr float storm_half_width_m = 24.0F, storm_radius_m = 1.8F;
constexpr uint32_t seeds_per_storm = 40;
/// Share of the tick that a handler for each event may take, and what a reload may take.
constexpr double share_max = 0.05, reload_max_ms = 100.0;

/// A handler for each event there is, which counts.
std::string counting_script() {
  std::string text = "local n = 0\nlocal sum = 0\n";
  for (const ApiEvent& event : api_events())
    text += fmt::format("on.{}(function(e) n = n + 1; sum = sum + (e.volume or e.energy or 1) end)\n",
                        event.name);
  return text;
}

RulesOptions rules_in(const ScratchFolder& scratch) {
  const std::filesystem::path folder(scratch / "counting");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "init.lua") << counting_script();
  RulesOptions options;
  options.folders = {folder.string()};
  return options;
}

}  // namespace

BenchReport run_rules_bench(const BenchOptions& options) {
  BenchReport report;
  const ScratchFolder scratch("rules");
  auto loaded = Rules::load(rules_in(scratch));
  report.check("rules_load", loaded.has_value(), loaded ? "they load" : loaded.error().message);
  if (!loaded) return report;
  Rules& rules = **loaded;
  rules.start({});
  WorldConfig config;
  config.work_percent = limits::work_percent_max;  // a storm, whatever the machine
  World world(config, 1);
  ScatteredBlows blows(config.terrain, storm_half_width_m, storm_radius_m, seeds_per_storm, 1);
  const Tick ticks = options.quick ? rules_ticks / 3 : rules_ticks;
  double rules_ms = 0.0, world_ms = 0.0;
  size_t most = 0, crowded = 0;
  for (Tick tick = 0; tick < ticks; ++tick) {
    std::vector<Command> asked;
    if (tick % ticks_between_storms == 0) asked.push_back({1, static_cast<uint32_t>(tick), blows.next()});
    TickCommands commands(std::move(asked));
    const double begin_ms = 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID);
    rules.before(world, commands);
    const double decided_ms = 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID);
    const auto delta = world.step(commands.let_through());
    const double stepped_ms = 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID);
    rules.after(*delta);
    const double told_ms = 1e3 * cpu_s(CLOCK_THREAD_CPUTIME_ID);
    most = std::max(most, delta->pieces.size());
    if (delta->pieces.size() < 900) continue;
    ++crowded;
    rules_ms += decided_ms - begin_ms + told_ms - stepped_ms;
    world_ms += stepped_ms - decided_ms;
    options.progress(static_cast<double>(tick + 1) / static_cast<double>(ticks));
  }
  report.metric("pieces_most", static_cast<double>(most));
  report.metric("ticks_of_900_pieces", static_cast<double>(crowded));
  const double share = rules_ms / (rules_ms + world_ms);
  report.metric("share", share);
  report.check(
      "share_of_the_tick", crowded > 0 && share <= share_max,
      fmt::format("handlers of all events take {:.1f} % of a tick's processor time with 900 to {} pieces, "
                  "at most {:.0f} %",
                  1e2 * share, most, 1e2 * share_max));
  const double begin_s = steady_now_s();
  const Result<void> again = rules.reload();
  const double reload_ms = 1e3 * (steady_now_s() - begin_s);
  report.metric("reload_ms", reload_ms);
  report.check("reload", again.has_value() && reload_ms <= reload_max_ms,
               fmt::format("a reload takes {:.1f} ms, at most {:.0f}, and no tick waits for it", reload_ms,
                           reload_max_ms));
  return report;
}

}  // namespace scree
