// Records ticks on a storage thread, so that the simulation does not wait for the disk. At most
// limits::recorder_queue_max ticks wait in the queue; when it is full, push() waits and counts it.
//
// When writing fails, the recording ends and is playable up to the last commit. The simulation goes on, and
// error() says why.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/store/recording.h"
#include "server/store/recording_writer.h"
#include "shared/base/result.h"

namespace scree {

class Recorder {
 public:
  static Result<std::unique_ptr<Recorder>> create(const std::string& path, const RecordingHeader& header,
                                                  RingLimit limit = {});
  /// Begins with that world; where the file exists, goes on with it (RecordingWriter::resume).
  static Result<std::unique_ptr<Recorder>> create(const std::string& path, const RecordingHeader& header,
                                                  const RecordingStart& start, RingLimit limit = {});
  /// Calls finish().
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Queues the next tick, without a gap from 1 or from the start on, and the commands that it carried out.
  /// `noted`: events of the machine; `part`: RecordingWriter::add(); `cursors`: all persons, where it is time
  /// to sample them. From one thread only. Does nothing after an error or after finish().
  void push(std::shared_ptr<const TickDelta> delta, std::vector<Command> commands,
            std::vector<Event> noted = {}, std::shared_ptr<const WorldMoment> part = nullptr,
            std::optional<std::vector<PlayerCursor>> cursors = std::nullopt);
  /// RecordingWriter::wants_part() of the last tick that was written. From any thread.
  PartWish wants_part() const;

  /// Waits until that tick, which was pushed or is the start's, is in the file, and survives the end of this
  /// process; or until the recording has ended. From any thread.
  void commit_up_to(Tick tick);

  /// Writes all queued ticks, closes the file and joins the thread. Returns the first error since the start.
  Result<void> finish();

  /// The first error, which ended the recording. From any thread.
  std::optional<std::string> error() const;
  uint64_t ticks_written() const;  ///< from any thread
  uint64_t waits() const;          ///< times that push() had to wait; from any thread
  RecordingSize size() const;      ///< as of the last commit; from any thread

 private:
  struct State;
  explicit Recorder(std::unique_ptr<State> state);
  /// `written`: the tick from which the writer goes on; 0: from the beginning.
  static std::unique_ptr<Recorder> start(std::unique_ptr<RecordingWriter> writer, Tick written);
  std::unique_ptr<State> state_;
};

}  // namespace scree
