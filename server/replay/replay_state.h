// What a ReplaySource is made of: the recording, and its world as it is played. Internal to ReplaySource.
#pragma once

#include <memory>

#include "server/replay/event_marks.h"
#include "server/replay/played_world.h"
#include "server/replay/recorded_cursors.h"
#include "server/replay/replay_source.h"

namespace scree {

struct ReplaySource::State {
  State(std::unique_ptr<RecordingReader> r, RecordingHeader h);

  /// The latest keyframe up to that tick, or the untouched terrain before tick 1; what it changes of the
  /// bricks is noted.
  Result<void> restore_before(Tick wanted, BricksBefore& before);
  /// The next tick: as of PlayedWorld.
  Result<std::shared_ptr<TickDelta>> advance(BricksBefore* before = nullptr, bool undoable = false);
  Result<void> go_to(Tick wanted, BricksBefore& before);
  Tick start() const { return reader->first_tick() - 1; }
  /// Whether an event may begin with the tick, for recordings without a log.
  Result<bool> begins_something(Tick at);

  std::unique_ptr<RecordingReader> reader;
  const RecordingHeader header;  ///< with its ground
  PlayedWorld world;
  bool keyframe_due = false;  ///< next() returns the whole state
  RecordedCursors cursors;
  EventMarks marks;
};

}  // namespace scree
