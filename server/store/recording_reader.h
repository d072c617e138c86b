// Reads a recording. Every byte is checked: a file that is none, is foreign, newer, cut short or damaged is
// refused in words that name it; nothing that it holds can crash the program. One thread at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/store/recording.h"
#include "shared/base/result.h"

namespace scree {

class RecordingReader {
 public:
  static Result<std::unique_ptr<RecordingReader>> open(const std::string& path);
  ~RecordingReader();

  const std::string& path() const;
  const RecordingHeader& header() const;
  /// Ticks are 1 … last_tick(), without a gap; a recording holds one at least.
  Tick last_tick() const;
  uint64_t keyframes() const;
  uint64_t bytes() const;  ///< of the file

  /// `tick` within 1 … last_tick().
  Result<RecordedFrame> frame(Tick tick);
  /// None for most ticks.
  Result<std::vector<Command>> commands(Tick tick);
  /// The latest keyframe that is not after `tick`; nothing when there is none: start before tick 1.
  Result<std::optional<RecordedKeyframe>> keyframe_before(Tick tick);

 private:
  struct State;
  explicit RecordingReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
