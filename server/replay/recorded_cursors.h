// The cursors of those who were there, at any moment of a recording: between two samples on the way from one
// to the other. One thread at a time.
#pragma once

#include <vector>

#include "server/store/recording_reader.h"

namespace scree {

class RecordedCursors {
 public:
  /// After that tick, ascending by session. While a recording is written, its last second may have none yet:
  /// then those before it hold.
  Result<std::vector<PlayerCursor>> at(RecordingReader& recording, Tick tick);

 private:
  std::vector<RecordedMachine> rows_;  ///< the last that were read, ascending
  std::vector<PlayerCursor> last_;
};

}  // namespace scree
