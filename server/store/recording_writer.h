// Writes a recording, tick by tick, in transactions: committed ticks stay playable after any later error or
// crash. All calls after create() come from one thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "proto/event.h"
#include "server/store/recording.h"
#include "server/store/recording_parts.h"
#include "server/store/recording_ring.h"
#include "shared/base/result.h"

namespace scree {

/// What cannot be begun leaves no file behind.
class RecordingWriter {
 public:
  static Result<std::unique_ptr<RecordingWriter>> create(const std::string& path,
                                                         const RecordingHeader& header, RingLimit limit = {});
  /// Begins with a world of some tick instead of an untouched one.
  static Result<std::unique_ptr<RecordingWriter>> create(const std::string& path,
                                                         const RecordingHeader& header,
                                                         const RecordingStart& start, RingLimit limit = {});
  /// Goes on with a recording of the same world where that stood at `start`: ticks after it, which the world
  /// has lost, are dropped. Refuses another world's, and one that ends before `start`. Nothing that was
  /// recorded changes before the first commit.
  static Result<std::unique_ptr<RecordingWriter>> resume(const std::string& path,
                                                         const RecordingHeader& header,
                                                         const RecordingStart& start, RingLimit limit = {});
  /// Commits, unless is_spoiled(), and ignores errors.
  ~RecordingWriter();

  /// Whether an error left this object and the file apart, so that nothing more can be added: all that was
  /// committed is in the file. Another error, as of a file that somebody else holds, lets the same call be
  /// tried again.
  bool is_spoiled() const;
  /// For a recording of create() without a start, and without a tick: begins with a world of some tick.
  Result<void> begin_with(const RecordingStart& start);
  /// Whether the limit has dropped any part.
  bool has_dropped() const;
  const std::string& path() const;

  /// For a recording that has a start, but no tick yet: adds the commands of the next tick, which is recorded
  /// by them alone. After the last such tick begin_at() takes the state.
  Result<void> add_unseen(Tick tick, std::span<const Command> commands);
  /// `keyframe` and `read`: as RecordingStart has them; the next tick follows.
  Result<void> begin_at(const TickDelta& keyframe, ReadChunk read = {});

  /// Adds the next tick, without a gap from 1 or from the start on, and the commands that it carried out. Its
  /// events are derived; `noted`: those of the machine. `state`: the world after the tick, where the next one
  /// begins as from a restored value (World::renew): a part begins there, and parts that the limit has no
  /// room for are dropped. `cursors`: all persons, where it is time to sample them. After an error the same
  /// tick may be added again, unless is_spoiled().
  Result<void> add(const TickDelta& delta, std::span<const Command> commands,
                   std::span<const Event> noted = {}, const WorldMoment* state = nullptr,
                   const std::optional<std::vector<PlayerCursor>>& cursors = std::nullopt);
  /// Where the rows of the machine have their time from, ms since 1970; else from the system's clock.
  void set_clock(std::function<uint64_t()> unix_ms);
  /// Notes who joined before the first tick.
  void note(const Participant& person);
  /// Whether a part should begin, so that the limit can be kept.
  PartWish wants_part() const;
  /// As of the last commit.
  const RecordingSize& size() const;
  /// Ends the transaction: everything added so far is in the file. An error when the file is not there any
  /// more under its name.
  Result<void> commit();
  /// Commits, and merges SQLite's log into the file, which is then readable from a read-only folder, unless
  /// another program reads it: then that one does so when it closes the file. The last call.
  Result<void> finish();

 private:
  struct State;
  explicit RecordingWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
