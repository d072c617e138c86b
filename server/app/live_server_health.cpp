// LiveServer's health: whether it ticks, and does what it promised.
#include <fmt/format.h>

#include "server/app/limits.h"
#include "server/app/live_server_state.h"
#include "server/log/log.h"
#include "server/store/store_fault.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

/// What is wrong with a file, for everybody who asks: without its name, and without the system's words.
std::string writing_fault(std::string_view what, const StoreHealth& health) {
  const auto fault = fault_in(*health.because);
  return fmt::format("{} has not been written since {}, and is tried again{}{}", what,
                     iso_time(health.since_unix_ms), fault ? ": " : "", fault ? name_of(*fault) : "");
}

/// How the world is not saved as promised; empty: it is.
std::string saving_fault(const SaverStatus& status, double waited_s) {
  if (!status.health.ok())
    return fmt::format("{}; the last tick on the disk is {}", writing_fault("the world", status.health),
                       status.saved_tick);
  if (waited_s > limits::save_delay_seconds_max)
    return fmt::format("the disk has not taken the world for {:.0f} s: the last tick on it is {}", waited_s,
                       status.saved_tick);
  return {};
}

std::string backup_fault(const StoreHealth& health) {
  const auto fault = fault_in(*health.because);
  return fmt::format("no backup has been made since {}, and it is tried again{}{}",
                     iso_time(health.since_unix_ms), fault ? ": " : "", fault ? name_of(*fault) : "");
}

}  // namespace

/// On the network thread.
ServerHealth LiveServer::State::health() const {
  ServerHealth found;
  if (!is_open) {
    found.add(HealthKind::starting, "the server is starting");
    return found;
  }
  const double now_s = steady_now_s();
  double waited_s = 0.0;
  bool ticks = true;
  {
    const std::scoped_lock lock(mutex);
    waited_s = save_delay.waited_s(now_s);
    ticks = running;
  }
  if (!ticks) found.add(HealthKind::stopping, "the server has ended");
  if (ticks && config.pacing == Pacing::real_time && heartbeat.stands_still(now_s))
    found.add(HealthKind::simulation,
              fmt::format("the simulation stands still: no tick has ended for {:.1f} s",
                          heartbeat.silent_s(now_s)));
  if (saved_world && !saved_world->is_temporary())
    if (const std::string fault = saving_fault(saved_world->status(), waited_s); !fault.empty())
      found.add(HealthKind::saving, fault);
  if (backups)
    if (const StoreHealth health = backups->status().health; !health.ok())
      found.add(HealthKind::backups, backup_fault(health));
  if (recorder)
    if (const StoreHealth health = recorder->health(); !health.ok())
      found.add(HealthKind::recording, writing_fault("the recording", health));
  if (events)
    if (const StoreHealth health = events->status().health; !health.ok())
      found.add(HealthKind::events, writing_fault("the log of events", health));
  if (history)
    if (const StoreHealth health = history->status().health; !health.ok())
      found.add(HealthKind::history, writing_fault("the history of edits", health));
  add_bus_faults(found);
  return found;
}

/// On the network thread, so that neither thread's end is missed.
void LiveServer::State::send_pulse(double now_s) {
  if (!config.pulse || now_s < pulse_at_s) return;
  pulse_at_s = now_s + limits::pulse_seconds;
  const NetStats stats = net->stats();
  LivePulse pulse{.sessions = stats.sessions, .sessions_max = stats.sessions_max};
  {
    const std::scoped_lock lock(mutex);
    pulse.tick = report.last_tick;
    pulse.late_ticks = report.late_ticks;
  }
  config.pulse(pulse);
}

/// On the network thread, for the simulation's cannot say it of itself.
void LiveServer::State::check_heartbeat(double now_s) {
  if (!is_open) return;
  check_bus(now_s);
  if (figure_hour.is_due(now_s)) sample_figures(now_s);
  if (config.pacing != Pacing::real_time) return;
  {
    const std::scoped_lock lock(mutex);
    if (!running) return;
  }
  if (!heartbeat.stands_still(now_s)) send_pulse(now_s);
  const auto line = heartbeat.check(now_s);
  if (!line) return;
  log_of(LogPart::world).write(heartbeat.stands_still(now_s) ? LogLevel::error : LogLevel::warn, *line);
}

}  // namespace scree
