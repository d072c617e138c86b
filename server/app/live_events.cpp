#include "server/app/live_events.h"

#include <algorithm>
#include <spdlog/spdlog.h>
#include <utility>

#include "server/store/event_lines.h"
#include "server/store/limits.h"

namespace scree {

namespace {

constexpr double ms_per_s = 1000.0;

}  // namespace

Result<std::unique_ptr<LiveEvents>> LiveEvents::open(const std::string& path, const WorldConfig& world,
                                                     const SettingValues& settings) {
  std::unique_ptr<EventLog> log;
  if (!path.empty()) {
    auto opened = TRY(EventLog::open(path));
    log = std::move(opened);
  }
  return std::unique_ptr<LiveEvents>(new LiveEvents(path, std::move(log), world, settings));
}

LiveEvents::LiveEvents(std::string path, std::unique_ptr<EventLog> log, const WorldConfig& world,
                       const SettingValues& settings)
    : path_(std::move(path)),
      log_(std::move(log)),
      deriver_(world.terrain.voxel_size_m, settings),
      tick_rate_hz_(world.tick_rate_hz) {}

void LiveEvents::note(Event event) {
  const std::scoped_lock lock(mutex_);
  if (noted_.size() < limits::noted_events_max) noted_.push_back(std::move(event));
}

std::vector<Event> LiveEvents::drain(const TickDelta& delta) {
  std::vector<Event> machine;
  {
    const std::scoped_lock lock(mutex_);
    machine.swap(noted_);
  }
  const double ms = delta.times.total_ms();
  if (ms > ms_per_s / tick_rate_hz_)
    machine.push_back({.kind = EventKind::slow, .ms = static_cast<float>(ms)});
  for (Event& event : machine) event.tick = delta.tick;
  if (!log_) return machine;
  for (const Event& event : deriver_.events_of(delta))
    log_->push(json_line(event, {tick_rate_hz_, static_cast<float>(ms)}));
  for (const Event& event : machine) log_->push(json_line(event, {tick_rate_hz_}));
  warn();
  return machine;
}

/// Once when it begins to fail, and once when it goes on.
void LiveEvents::warn() {
  const EventLog::Status status = log_->status();
  if (std::exchange(failing_, status.error.has_value()) == failing_) return;
  if (failing_)
    spdlog::warn("{}: {} events are lost (--events); the server goes on", *status.error, status.lost);
  else
    spdlog::info("{} is written again, after {} events were lost (--events)", path_, status.lost);
}

}  // namespace scree
