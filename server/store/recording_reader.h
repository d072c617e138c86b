// Reads a recording. Every byte is checked: a file that is no recording, of another program or release, cut
// short or damaged is refused with an error that names it. No content can crash the program. One thread at a
// time.
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
  /// The recording holds the ticks first_tick() … last_tick() without a gap, at least one. Where the first is
  /// not 1, state() has the world before it.
  Tick first_tick() const;
  Tick last_tick() const;
  uint64_t keyframes() const;
  uint64_t bytes() const;  ///< of the file

  /// The world after the tick, encoded (proto/world_codec.h), where the simulation of the next one began with
  /// it; most ticks have none.
  Result<std::optional<std::vector<uint8_t>>> state(Tick tick);
  /// The latest tick up to `tick` whose state() there is; 0 when there is none: then a world begins
  /// untouched.
  Result<Tick> state_before(Tick tick);
  /// `tick` within first_tick() … last_tick().
  Result<RecordedFrame> frame(Tick tick);
  /// The commands of a tick within first_tick() … last_tick(); most ticks have none.
  Result<std::vector<Command>> commands(Tick tick);
  /// The latest keyframe up to `tick`, which is at most last_tick(); nothing when there is none: then play
  /// from tick 1.
  Result<std::optional<RecordedKeyframe>> keyframe_before(Tick tick);

 private:
  struct State;
  explicit RecordingReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
