#include "server/app/live_events.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "server/log/log.h"
#include "server/store/event_lines.h"
#include "server/store/limits.h"
#include "server/world/stages.h"
#include "shared/base/timing.h"
#include "shared/base/wall_clock.h"

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
      tick_rate_hz_(world.tick_rate_hz),
      voxel_size_m_(world.terrain.voxel_size_m) {}

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
  if (ms > ms_per_s / tick_rate_hz_) machine.push_back(slow(delta, ms));
  for (Event& event : machine) {
    event.tick = delta.tick;
    roster_.note(event);
  }
  if (!log_) return machine;
  for (const Event& event : deriver_.events_of(delta)) log(event, static_cast<float>(ms));
  for (const Event& event : machine) log(event, std::nullopt);
  warn();
  return machine;
}

/// Its longest stage, and of that stage's operations the one that changed most, with who asked for it.
Event LiveEvents::slow(const TickDelta& delta, double ms) const {
  Event event{.kind = EventKind::slow, .tick = delta.tick, .ms = static_cast<float>(ms)};
  const TickStageRow& longest = *std::ranges::max_element(
      tick_stages, {}, [&](const TickStageRow& row) { return delta.times[row.stage]; });
  event.text = fmt::format("{} {:.1f} ms", longest.name, delta.times[longest.stage]);
  const AppliedOperation* largest = nullptr;
  const auto size = [](const AppliedOperation& applied) {
    return std::pair(applied.created.size(), applied.writes.size());
  };
  for (const AppliedOperation& applied : delta.operations)
    if (applied.stage == longest.stage && (largest == nullptr || size(applied) > size(*largest)))
      largest = &applied;
  if (largest == nullptr) return event;
  event.place_m = place_of(*largest, delta, voxel_size_m_);
  event.session = largest->session;
  if (largest->party != 0) event.text += fmt::format(", party {}", largest->party);
  return event;
}

void LiveEvents::log(const Event& event, std::optional<float> tick_ms) {
  const Participant who = event.session == 0 ? Participant() : roster_.find(event.session);
  log_->push(json_line(event, {tick_rate_hz_, tick_ms, unix_now_ms(), who}));
}

/// Once when it begins to fail, and once when it goes on.
void LiveEvents::warn() {
  const EventLog::Status status = log_->status();
  if (std::exchange(failing_, !status.health.ok()) == failing_) return;
  const auto more = log_limit_.admit(failing_ ? "failing" : "written again", steady_now_s());
  if (!more) return;
  if (failing_)
    log_of(LogPart::store)
        .warn("{}: events wait, and are tried again (--events){}", *status.health.because, *more);
  else
    log_of(LogPart::store)
        .info("{} is written again; {} events are lost (--events){}", path_, status.health.lost, *more);
}

}  // namespace scree
