// What a server's figures cost a tick, and what their page costs (docs/monitoring.md).
#include <algorithm>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/scenes.h"
#include "server/app/server_metrics.h"
#include "server/publish/shared_bytes.h"
#include "server/work/limits.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr Tick figures_ticks = 900, ticks_between_carves = 3;
constexpr float carves_half_width_m = 24.0F, carve_radius_m = 1.8F;
constexpr uint32_t seeds_per_carve = 40;
constexpr size_t sessions_counted = 64, pages = 50, pieces_least = 900;
/// Share of the tick that all figures may take, and what a page may take of the network's thread.
constexpr double figures_share_max = 0.005, page_max_ms = 10.0;

/// All that is counted of a tick, on both threads, with a frame and a reply for each session.
struct CountedTick {
  ServerReport report;
  MessageCounts messages;
  Durations frame_age;

  void add(const TickDelta& delta, const TickParts& parts, std::span<const SharedBytes> frames) {
    report.whole_tick.add(parts.total_ms());
    report.whole_tick_cpu.add(parts.cpu_ms);
    report.terrain_in.add(parts[TickPart::terrain]);
    report.after_tick.add(parts[TickPart::keep]);
    report.add(delta);
    report.add(parts);
    for (size_t session = 0; session < sessions_counted; ++session)
      for (const SharedBytes& bytes : frames) messages.add_out(*bytes);
    frame_age.add(parts.total_ms(), sessions_counted);
  }
};

}  // namespace

BenchReport run_figures_bench(const BenchOptions& options) {
  BenchReport report;
  WorldConfig config;
  config.work_percent = limits::work_percent_max;  // a storm, whatever the machine
  World world(config, 1);
  ScatteredBlows blows(config.terrain, carves_half_width_m, carve_radius_m, seeds_per_carve, 1);
  const std::array frames{share(ServerMessage(FrameMessage{})), share(ServerMessage(ReplyMessage{}))};
  CountedTick counted;
  const Tick ticks = options.quick ? figures_ticks / 3 : figures_ticks;
  double figures_ms = 0.0, world_ms = 0.0;
  size_t most = 0, crowded = 0;
  for (Tick tick = 0; tick < ticks; ++tick) {
    std::vector<Command> asked;
    if (tick % ticks_between_carves == 0) asked.push_back({1, static_cast<uint32_t>(tick), blows.next()});
    const double begin_s = thread_cpu_s();
    const auto delta = world.step(asked);
    const double stepped_s = thread_cpu_s();
    TickParts parts;
    parts[TickPart::simulation] = parts.cpu_ms = 1e3 * (stepped_s - begin_s);
    counted.add(*delta, parts, frames);
    const double counted_s = thread_cpu_s();
    most = std::max(most, delta->pieces.size());
    options.progress(static_cast<double>(tick + 1) / static_cast<double>(ticks));
    if (delta->pieces.size() < pieces_least) continue;
    ++crowded;
    world_ms += 1e3 * (stepped_s - begin_s);
    figures_ms += 1e3 * (counted_s - stepped_s);
  }
  report.metric("pieces_most", static_cast<double>(most));
  report.metric("ticks_of_900_pieces", static_cast<double>(crowded));
  const double share = figures_ms / (figures_ms + world_ms);
  const double figures_us = 1e3 * figures_ms / static_cast<double>(std::max<size_t>(1, crowded));
  report.metric("share", share);
  report.metric("figures_us", figures_us);
  report.check(
      "share_of_the_tick", crowded > 0 && share <= figures_share_max,
      fmt::format("the figures of a tick take {:.1f} us, with messages to {} sessions: {:.3f} % of one "
                  "with {} to {} pieces, at most {:.1f} %",
                  figures_us, sessions_counted, 1e2 * share, pieces_least, most, 1e2 * figures_share_max));
  size_t bytes = 0;
  const double begin_s = thread_cpu_s();
  for (size_t page = 0; page < pages; ++page) {
    NetFigures figures;
    figures.messages = counted.messages;
    figures.frame_age = counted.frame_age;
    bytes = metrics_text(counted.report, figures, {60, false, nullptr}, {0.25F, 1, {}}).size();
  }
  const double page_ms = 1e3 * (thread_cpu_s() - begin_s) / static_cast<double>(pages);
  report.metric("page_ms", page_ms);
  report.metric("page_bytes", static_cast<double>(bytes));
  report.check(
      "page", page_ms <= page_max_ms,
      fmt::format("a page of {} KiB takes {:.2f} ms, at most {:.0f}", bytes / 1024, page_ms, page_max_ms));
  return report;
}

}  // namespace scree
