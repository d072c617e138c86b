// Who the sessions of a recording are, and the time of day of its ticks, as its rows of the machine say. Rows
// are given in order. One thread at a time.
#pragma once

#include <map>
#include <span>

#include "server/store/recording_reader.h"
#include "server/store/roster.h"

namespace scree {

class RecordedPeople {
 public:
  explicit RecordedPeople(uint32_t tick_rate_hz) : tick_rate_hz_(tick_rate_hz) {}

  /// Later rows; those that were given already change nothing.
  void add(std::span<const RecordedMachine> rows);
  Participant find(uint64_t session) const { return roster_.find(session); }
  std::vector<Participant> all() const { return roster_.all(); }
  /// Milliseconds since 1970, by the rate of ticks since the nearest row; 0: no row says it.
  uint64_t unix_ms(Tick tick) const;

 private:
  uint32_t tick_rate_hz_;
  Roster roster_;
  std::map<Tick, uint64_t> times_;  ///< of the last rows
};

}  // namespace scree
