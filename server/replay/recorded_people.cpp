#include "server/replay/recorded_people.h"

namespace scree {

namespace {

/// Rows whose times are remembered: more than a batch of ticks has.
constexpr size_t times_max = 4096;

}  // namespace

void RecordedPeople::add(std::span<const RecordedMachine> rows) {
  for (const RecordedMachine& row : rows) {
    for (const Participant& person : row.persons) roster_.add(person);
    for (const Event& event : row.events) roster_.note(event);
    if (row.unix_ms != 0) times_[row.tick] = row.unix_ms;
    if (times_.size() > times_max) times_.erase(times_.begin());
  }
}

uint64_t RecordedPeople::unix_ms(Tick tick) const {
  if (times_.empty()) return 0;
  auto near = times_.lower_bound(tick);  // a row ends with its tick
  if (near == times_.end()) --near;
  constexpr int64_t ms_per_s = 1000;
  const auto later = static_cast<int64_t>(tick) - static_cast<int64_t>(near->first);
  const int64_t time =
      static_cast<int64_t>(near->second) + later * ms_per_s / static_cast<int64_t>(tick_rate_hz_);
  return time > 0 ? static_cast<uint64_t>(time) : 0;
}

}  // namespace scree
