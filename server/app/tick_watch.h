// Watches the simulation's thread from one tick to the next, for the flight recorder: what the system gave
// it, and how long each part took. On that thread alone.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "server/app/terrain_pager.h"
#include "server/flight/flight_tick.h"
#include "server/net/net_server.h"
#include "server/store/world_saver.h"
#include "shared/base/timing.h"

namespace scree {

class TickWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// A tick begins that was due then, or when the one before ended, if that was later; `due` may be empty.
  void begin(std::optional<Clock::time_point> due);
  /// The next part begins; the time since the last call is the member's.
  void part(float FlightTick::*member) { now_.*member = static_cast<float>(lap_.lap_ms()); }
  void storage(const SaverStatus& status, const PagerStatus& paging);
  /// The tick has ended.
  FlightTick end(const NetLoad& net);

 private:
  /// Counts of the system since the start.
  struct Counts {
    uint64_t major_faults = 0, preempted = 0;
    double thread_system_ms = 0.0, process_system_ms = 0.0;  ///< processor time in the kernel
  };
  static Counts counts();

  FlightTick now_;
  Stopwatch lap_;
  Clock::time_point began_, ended_{};
  double thread_s_ = 0.0, process_s_ = 0.0;  ///< on processors, when it began
  Counts before_ = counts();  ///< at the last tick's end: pages also come in while the thread sleeps
  uint64_t saves_ = 0, skipped_ = 0, waits_ = 0;
};

}  // namespace scree
