// A recording as a stream of ticks with the same content as live ones: a viewer cannot tell the difference.
//
// No simulation runs: the kernels in `shared` apply the operations to a plain field. The hash of every tick
// is compared with the recorded one. One thread at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "server/store/recording_reader.h"
#include "server/world/tick_delta.h"

namespace scree {

class ReplaySource {
 public:
  /// Opens a recording, and seeks to tick `from`. `ground` gives it the ground that it names. Where ticks are
  /// awaited it may have none: then it stands at tick 0, and last_tick() is that, too.
  static Result<std::unique_ptr<ReplaySource>> open(const std::string& path, Tick from = 0,
                                                    const GroundGiver& ground = {},
                                                    WithoutTicks without_ticks = WithoutTicks::refused);
  ~ReplaySource();

  const RecordingHeader& header() const;  ///< with its ground
  Tick tick() const;        ///< the last one that was played; that before the first at the start
  Tick first_tick() const;  ///< the state before the recording's first tick
  Tick last_tick() const;
  bool is_ended() const;  ///< RecordingReader::is_ended()
  /// RecordingReader::refresh(): the last tick of a recording that is being written may move on, and the
  /// first one of a ring past tick(): then only jump() and seek() go on.
  Result<void> refresh();
  /// RecordingReader::let_go().
  void let_go();

  /// The next tick; null at the end. A tick that cannot be applied, or whose field has another hash than
  /// recorded, is an error that names the tick.
  Result<std::shared_ptr<const TickDelta>> next();

  /// The next ticks as one, up to `count` of them (at least one), the last one's number: fewer at the end,
  /// and where they are more work for a client than a frame may be. An error at the end is next()'s.
  Result<std::shared_ptr<const TickDelta>> next(Tick count);
  /// Goes to a tick within first_tick() … last_tick(), which may be before this one; the result takes who has
  /// this one's state to that one's: the bricks that differ (TickDelta::reverted, too), pieces, no
  /// operations.
  Result<std::shared_ptr<const TickDelta>> jump(Tick to);
  /// Where visitors begin at this moment. Ticks tell when it moves only once somebody has asked.
  Spawn spawn();
  /// A tick in which nothing changes.
  std::shared_ptr<const TickDelta> same() const;
  /// The cursors of those who were there at this moment.
  Result<std::vector<PlayerCursor>> cursors();
  /// The recording's events, as far as they are read: some more with each call. The same value until it
  /// changes; null where there is no log of events.
  Result<std::shared_ptr<const MarksMessage>> marks();
  /// The nearest tick with an event after that one, or before it; nothing when there is none. Recordings
  /// without a log of events are looked through for ticks with operations that begin something.
  Result<std::optional<Tick>> next_event(Tick after);
  Result<std::optional<Tick>> previous_event(Tick before);

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
