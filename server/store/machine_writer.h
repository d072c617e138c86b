// Writes what a recording has of the machine: the durations of ticks, the events of sessions and slow ticks,
// persons and their cursors, and the time of day, in a row a second. Owned by a RecordingWriter; one thread
// at a time.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "proto/event.h"
#include "server/store/cursor_track.h"
#include "server/store/database.h"
#include "server/store/roster.h"
#include "server/world/tick_delta.h"
#include "shared/base/wall_clock.h"

namespace scree {

class MachineWriter {
 public:
  /// `database` must outlive it.
  static Result<MachineWriter> create(Database& database);

  /// The next tick's; writes a row when it is time. `cursors`: all persons', where it is time to sample them.
  Result<void> add(const TickDelta& delta, std::span<const Event> noted,
                   const std::optional<std::vector<PlayerCursor>>& cursors);
  /// What is not in a row yet.
  Result<void> put();

  /// Who joined before the next tick.
  void note(const Participant& person) { roster_.add(person); }
  /// The next row says who is there: a part begins, and those before it may be dropped.
  void tell_persons() { tells_persons_ = true; }
  /// Where rows have their time from, ms since 1970; else from the system's clock.
  void set_clock(std::function<uint64_t()> unix_ms) { unix_ms_ = std::move(unix_ms); }

 private:
  explicit MachineWriter(Database& database) : database_(&database) {}
  void add_cursors(Tick tick);

  Database* database_;
  Statement put_row_;
  RecordedMachine row_;  ///< since the last one
  CursorTrack cursors_;  ///< in it
  std::vector<PlayerCursor> last_cursors_;
  size_t cursor_entries_ = 0;  ///< in the row
  bool has_row_ = false;       ///< from this process
  Roster roster_;
  bool tells_persons_ = false;
  std::function<uint64_t()> unix_ms_ = unix_now_ms;
};

}  // namespace scree
