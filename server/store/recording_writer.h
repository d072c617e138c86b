// Writes a recording, tick by tick, in transactions: what is committed stays playable whatever happens next.
// One thread at a time.
#pragma once

#include <memory>
#include <string>

#include "server/store/recording.h"
#include "shared/base/result.h"

namespace scree {

class RecordingWriter {
 public:
  static Result<std::unique_ptr<RecordingWriter>> create(const std::string& path,
                                                         const RecordingHeader& header);
  /// Commits what was added, as far as possible.
  ~RecordingWriter();

  /// The next tick, the first being 1, and the commands that it carried out.
  Result<void> add(const TickDelta& delta, std::span<const Command> commands);
  Result<void> commit();
  /// Commits, and leaves one plain file, that can be read where nothing may be written. The last call.
  Result<void> finish();

 private:
  struct State;
  explicit RecordingWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
