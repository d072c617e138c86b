// A recording as a stream of ticks, with the same content as live ones: a viewer cannot tell the difference.
//
// Needs no simulation: operations are applied to a plain field by the kernels that everybody shares. Every
// tick is checked against its recorded hash. One thread at a time.
#pragma once

#include <memory>
#include <string>

#include "server/store/recording_reader.h"
#include "server/world/tick_delta.h"

namespace scree {

class ReplaySource {
 public:
  /// `from`: where to start, as in seek().
  static Result<std::unique_ptr<ReplaySource>> open(const std::string& path, Tick from = 0);
  ~ReplaySource();

  const RecordingHeader& header() const;
  Tick tick() const;
  Tick last_tick() const;

  /// The next tick; null at the end. A tick that cannot be applied, or whose field does not hash to what was
  /// recorded, is an error that names it.
  Result<std::shared_ptr<const TickDelta>> next();

  /// Goes on after `tick`, by the nearest keyframe: next() then gives the whole state after `tick` as one
  /// keyframe. 0: goes on with tick 1.
  Result<void> seek(Tick tick);

 private:
  struct State;
  explicit ReplaySource(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
