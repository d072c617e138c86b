// Keyframes of recordings of earlier releases: whole ones, and those that have what changed since the last
// whole one (schema.h). Every byte is checked. Owned by a RecordingReader; one thread at a time.
#pragma once

#include <optional>

#include "server/formats/recording_codec.h"
#include "server/store/database.h"

namespace scree {

class EarlierKeyframes {
 public:
  /// `database` must outlive it.
  static Result<EarlierKeyframes> open(Database& database);

  /// The tick of the latest one up to that tick; nothing when there is none.
  Result<std::optional<Tick>> tick_before(Tick tick);
  /// The latest one up to that tick.
  Result<std::optional<RecordedKeyframe>> read_before(Tick tick);
  Result<uint64_t> count();  ///< whole ones

 private:
  explicit EarlierKeyframes(Database& database) : database_(&database) {}
  Result<std::optional<Tick>> latest(const std::string& table, Tick tick);
  /// The one of a tick that has one.
  Result<RecordedKeyframe> row(const Statement& select, Tick tick);

  Database* database_;
  Statement select_whole_, select_short_;  ///< the second is null where there is no such table
};

}  // namespace scree
