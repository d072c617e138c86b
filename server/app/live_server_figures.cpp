// LiveServer's figures: what its ticks are counted by, and what operators see of them.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "server/app/live_server_state.h"
#include "server/app/server_metrics.h"
#include "server/app/server_status.h"
#include "server/log/log.h"
#include "server/log/recent_lines.h"
#include "server/world/settings.h"

namespace scree {

void LiveServer::State::count(TickSchedule::Delay delay) {
  if (!delay.late) return;
  const std::scoped_lock lock(mutex);
  ++report.late_ticks;
  report.late.add(parts, std::chrono::duration<double, std::milli>(period).count());
  if (delay.lost_ticks == 0) return;
  report.overruns += delay.lost_ticks;
  // A replay may take its time for a jump.
  if (const auto more = log_limit.admit("late", steady_now_s()))
    log_of(LogPart::world)
        .write(config.replay.path.empty() ? LogLevel::warn : LogLevel::debug,
               fmt::format("tick {} came {} ticks late: they are lost{}", report.last_tick, delay.lost_ticks,
                           *more));
}

ServerReport LiveServer::State::report_now(const NetStats& stats, const LatencyCounts& latency) const {
  const std::scoped_lock lock(mutex);
  ServerReport now = report;
  now.net = stats;
  now.latency = latency;
  now.seconds = std::chrono::duration<double>(Clock::now() - started).count();
  if (recorder) {
    now.ticks_recorded = recorder->ticks_written();
    now.record_waits = recorder->waits();
    now.record_size = recorder->size();
    now.record_path = recorder->path();
    now.recording = recorder->health();
    now.record_waiting = recorder->waiting();
    now.record_commits = recorder->commits();
  }
  if (saved_world && !saved_world->is_temporary()) {
    now.saving = saved_world->status();
    now.saves = saved_world->save_times();
  }
  now.resident_mb = resident_bytes() / bytes_per_mb;
  if (pager) {
    now.paging = pager->status();
    now.work.memory_mb = now.paging.memory_mb;
    now.requests_held = told.paging.requests_held;
  }
  if (events) now.events = events->status();
  if (history) now.history = history->status();
  return now;
}

/// On the network thread.
std::string LiveServer::State::status(const NetFigures& figures) const {
  if (!is_open) return {};
  return status_json(report_now(figures.stats, figures.latency), figures,
                     {config.world.tick_rate_hz, config.net.replay, config.net.palette});
}

/// Likewise.
std::string LiveServer::State::metrics(const NetFigures& figures) const {
  if (!is_open) return {};
  return metrics_text(report_now(figures.stats, figures.latency), figures,
                      {config.world.tick_rate_hz, config.net.replay, config.net.palette},
                      {config.world.terrain.voxel_size_m, started_unix_s, figures_beside()});
}

void LiveServer::State::sample_figures(double now_s) {
  const ServerReport now = report_now(net->stats(), net->latency());
  double worst_ms = 0.0;
  {
    const std::scoped_lock lock(mutex);
    worst_ms = std::exchange(worst_tick_ms, 0.0);
  }
  figure_hour.sample(now_s, now, worst_ms);
}

/// Those of the table, as they stand.
std::vector<std::string> LiveServer::State::setting_lines() const {
  std::map<std::string, std::string, std::less<>> values;
  {
    const std::scoped_lock lock(mutex);
    for (const SettingValue& setting : report.settings) values[setting.name] = setting.value;
  }
  std::vector<std::string> lines;
  for (const Setting& setting : settings()) {
    const auto value = values.find(setting.name);
    if (value == values.end()) continue;
    nlohmann::ordered_json json{{"name", setting.name}, {"value", value->second}, {"help", setting.help}};
    if (!setting.choices.empty()) {
      json["choices"] = setting.choices;
    } else if (setting.is_text()) {
      json["may_be"] = setting.text.may_be;
    } else {
      json["least"] = setting.bounds.min;
      json["greatest"] = setting.bounds.max;
      json["unit"] = setting.bounds.unit;
      json["whole"] = setting.bounds.whole;
    }
    lines.push_back(json.dump());
  }
  return lines;
}

/// On the network thread.
std::vector<std::string> LiveServer::State::lines(LinesOf of) const {
  switch (of) {
    case LinesOf::audit:
      return audit->lines();
    case LinesOf::log:
      return recent_lines();
    case LinesOf::figures:
      return figure_hour.lines();
    case LinesOf::settings:
      return setting_lines();
  }
  return {};
}

}  // namespace scree
