// The flight recorder: what the last ten minutes of ticks cost, who caused it, and why some were slow. In
// memory (limits.h says how much), and, where a file was named, each slow tick as a line of JSON. add() and
// the questions may come from different threads.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "server/flight/diagnosis.h"
#include "server/flight/limits.h"
#include "server/flight/party_work.h"
#include "server/store/event_log.h"
#include "shared/base/rate_limit.h"

namespace scree {

struct FlightConfig {
  uint32_t tick_rate_hz = 60;
  float voxel_size_m = 0.25F;
  SlowLimits slow{limits::slow_ms_default, limits::slow_save_ms_default};
  std::string log_path;  ///< of slow ticks; empty: none
  std::function<std::string_view(uint8_t request)> request_name;
};

/// Slow ticks of one culprit that followed each other: the worst of them.
struct SlowEpisode {
  FlightTick worst;
  Diagnosis diagnosis;
  uint32_t ticks = 1;  ///< how many were slow
  std::string words;
  std::string name;  ///< of the person who caused it; empty: nobody, or without a name
};

/// The line of the log.
std::string slow_line(const SlowEpisode& slow, std::span<const FlightCause> causes, const FlightNames& names,
                      uint64_t left_out);

/// Fills in what the delta says: stages, work, counts. The causes, the dearest first.
std::vector<FlightCause> causes_of(const TickDelta& delta, float voxel_size_m);
void describe(const TickDelta& delta, FlightTick& tick);
/// Where most pieces lie, if that is a crowd.
FlightCrowd crowd_of(const TickDelta& delta, const PartyCounts& parties);

class FlightRecorder {
 public:
  static Result<std::unique_ptr<FlightRecorder>> open(FlightConfig config);
  explicit FlightRecorder(FlightConfig config);

  /// After each tick; `tick` has all that the delta does not know.
  void add(FlightTick tick, const TickDelta& delta);
  /// Notes the name of a session that joined, for later.
  void name(uint64_t session, const std::string& name);
  /// Those that were slow since that time, the oldest first; at most limits::slow_rows_max.
  std::vector<SlowEpisode> slow(uint64_t since_unix_ms) const;
  /// The `most` ticks since then that made the game latest, or else took longest, slow or not.
  std::vector<SlowEpisode> worst(uint64_t since_unix_ms, size_t most) const;
  std::vector<PartyWork> parties() const;
  /// What it has in memory at most, and now.
  static size_t bytes_max();
  size_t ticks_kept() const;
  /// Writes the log's last lines.
  Result<void> finish();

 private:
  FlightNames names() const;
  void keep(const FlightTick& tick, std::span<const FlightCause> causes);
  void note_slow(const FlightTick& tick, std::span<const FlightCause> causes, const Diagnosis& found);
  void log(const SlowEpisode& slow, std::span<const FlightCause> causes);
  SlowEpisode episode_of(const FlightTick& tick, const Diagnosis& found) const;
  std::vector<FlightCause> causes_in(Tick tick) const;
  double seconds_at(Tick tick) const { return static_cast<double>(tick) / config_.tick_rate_hz; }

  const FlightConfig config_;
  std::unique_ptr<EventLog> log_;  ///< null: none
  mutable std::mutex mutex_;       ///< guards the members below
  std::deque<FlightTick> ticks_;
  struct Kept {
    Tick tick;
    FlightCause cause;
  };
  std::deque<Kept> causes_;  ///< of ticks_, in order
  std::deque<SlowEpisode> slow_;
  Tick last_tick_ = 0;
  PartyCounts parties_;
  std::map<uint64_t, std::string> names_;  ///< by session: numbers grow
  RateLimit lines_;
  uint64_t lines_left_out_ = 0;
};

}  // namespace scree
