// What changes of persons' cursors from one moment to the next, for a recording. One thread at a time.
#pragma once

#include <map>
#include <optional>
#include <span>

#include "proto/cursor.h"

namespace scree {

class CursorTrack {
 public:
  /// `cursors`: all persons', ascending by session. Nothing when nothing changed.
  std::optional<CursorSample> changes(Tick tick, std::span<const PlayerCursor> cursors);
  /// The next changes() are all persons there are.
  void forget() { known_.clear(); }

 private:
  std::map<uint64_t, PlayerCursor> known_;
};

}  // namespace scree
