// The events of a live server: those of its world, derived tick by tick, and those of the machine, which
// other threads note. They go into its log (--events), and the machine's into its recording.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/store/event_deriver.h"
#include "server/store/event_log.h"
#include "server/store/roster.h"
#include "server/world/world_config.h"
#include "shared/base/log_limit.h"

namespace scree {

class LiveEvents {
 public:
  /// `path`: of the log; empty: none. `settings`: before the next tick.
  static Result<std::unique_ptr<LiveEvents>> open(const std::string& path, const WorldConfig& world,
                                                  const SettingValues& settings);

  /// An event of the machine, without its tick. From any thread; above limits::noted_events_max it is lost.
  void note(Event event);

  /// The machine's events up to this tick, the next one; logs these and the world's.
  std::vector<Event> drain(const TickDelta& delta);

  /// Who joined; from the thread of drain().
  std::vector<Participant> persons() const { return roster_.all(); }
  const std::string& path() const { return path_; }
  /// EventLog::finish().
  Result<void> finish() { return log_ ? log_->finish() : Result<void>(); }
  EventLog::Status status() const { return log_ ? log_->status() : EventLog::Status{}; }

 private:
  LiveEvents(std::string path, std::unique_ptr<EventLog> log, const WorldConfig& world,
             const SettingValues& settings);
  Event slow(const TickDelta& delta, double ms) const;
  void log(const Event& event, std::optional<float> tick_ms);
  void warn();

  std::string path_;
  std::unique_ptr<EventLog> log_;  ///< null: none
  EventDeriver deriver_;
  uint32_t tick_rate_hz_;
  float voxel_size_m_;
  Roster roster_;
  bool failing_ = false;
  LogLimit log_limit_;
  std::mutex mutex_;
  std::vector<Event> noted_;  ///< guarded by mutex_
};

}  // namespace scree
