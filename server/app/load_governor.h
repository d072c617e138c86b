// Lowers the share of a tick that the simulation's work may take while ticks are lost, and raises it again. A
// late tick that the next ones catch up with costs nobody anything: it is left alone.
//
// The model of that work (server/work/work.h) knows no clock, so that the same commands give the same hashes
// on every machine. A machine that is slower than the model's, or busy with other things, would run late for
// ever. What the governor wants becomes a command, a change of the setting work-percent, which is recorded
// like all. It raises to what the
// server was started with, or what an administrator chose since. Not thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "server/app/limits.h"

namespace scree {

class LoadGovernor {
 public:
  /// `most`: percent that work may take, unless somebody chooses another number.
  LoadGovernor(uint32_t tick_rate_hz, uint32_t most);

  /// Somebody set what work may take.
  void chosen(uint32_t percent) { most_ = percent; }

  /// A tick ended: it took `length` of a tick's length by the clock, and `lost` ticks of real time were lost
  /// after it. `percent` is what its work may take now. Returns what it should be from now on, if that is
  /// something else; a new answer comes after limits::governor_interval_s at the soonest.
  std::optional<uint32_t> tick_ended(double length, uint64_t lost, uint32_t percent);

 private:
  uint32_t wanted_after_interval(uint32_t percent);

  uint32_t ticks_per_interval_;
  uint32_t most_;       ///< that it raises to
  uint32_t ticks_ = 0;  ///< since the last look
  uint32_t late_ = 0;   ///< of these
  std::array<uint32_t, limits::governor_intervals>
      losses_{};                 ///< times that ticks were lost, by look; this one last
  uint32_t calm_intervals_ = 0;  ///< in a row
};

}  // namespace scree
