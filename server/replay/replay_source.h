// A recording as a stream of ticks with the same content as live ones: a viewer cannot tell the difference.
//
// No simulation runs: the kernels in `shared` apply the operations to a plain field. The hash of every tick
// is compared with the recorded one. One thread at a time.
#pragma once

#include <memory>
#include <string>

#include "server/store/recording_reader.h"
#include "server/world/tick_delta.h"

namespace scree {

class ReplaySource {
 public:
  /// Opens a recording, and seeks to tick `from`. `ground` gives it the ground that it names.
  static Result<std::unique_ptr<ReplaySource>> open(const std::string& path, Tick from = 0,
                                                    const GroundGiver& ground = {});
  ~ReplaySource();

  const RecordingHeader& header() const;  ///< with its ground
  Tick tick() const;  ///< the last one that was played; that before the first at the start
  Tick last_tick() const;

  /// The next tick; null at the end. A tick that cannot be applied, or whose field has another hash than
  /// recorded, is an error that names the tick.
  Result<std::shared_ptr<const TickDelta>> next();

  /// Continues after `tick`, starting from the nearest keyframe: the following next() returns the whole state
  /// after `tick` as one keyframe. 0: plays from the start. An error beyond last_tick(), and before a start
  /// that is not tick 1.
  Result<void> seek(Tick tick);

 private:
  struct State;
  explicit ReplaySource(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
