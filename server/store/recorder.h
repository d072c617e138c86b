// Records ticks on a storage thread, so that the simulation does not wait for the disk. At most
// limits::recorder_queue_max ticks wait in the queue; when it is full, push() waits and counts it.
//
// A write that fails is tried again after growing pauses (retry_pause.h). While another program holds the
// file, ticks wait in the queue, and nothing is lost as long as they fit. Otherwise the recording ends there,
// playable up to its last commit, and goes on in another part beside it (recording_parts.h) as soon as a file
// can be written: it asks for a world to begin that part with (wants_start()). Ticks in between are in no
// part, and counted. The simulation goes on, and never waits for a disk that fails; for one that hangs it
// waits once, limits::recorder_patience_s.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/metrics/durations.h"
#include "server/store/recording.h"
#include "server/store/recording_writer.h"
#include "server/store/retry_pause.h"
#include "shared/base/result.h"

namespace scree {

class Recorder {
 public:
  static Result<std::unique_ptr<Recorder>> create(const std::string& path, const RecordingHeader& header,
                                                  RingLimit limit = {});
  /// Begins with that world; where the file exists, goes on with it (RecordingWriter::resume).
  static Result<std::unique_ptr<Recorder>> create(const std::string& path, const RecordingHeader& header,
                                                  const RecordingStart& start, RingLimit limit = {});
  /// For a server, which is to start whatever its last end was: goes on with the part that reaches to the
  /// world, or begins another part. `start`: as above; null for an untouched world. While the disk refuses,
  /// it is tried again later. An error: the path leads to another kind of file, or nowhere. The log tells
  /// what is not as it was asked for.
  static Result<std::unique_ptr<Recorder>> open(const std::string& path, const RecordingHeader& header,
                                                const RecordingStart* start, RingLimit limit = {});
  /// Calls finish().
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Queues the next tick, without a gap from 1 or from the start on, and the commands that it carried out.
  /// `noted`: events of the machine; `part`: RecordingWriter::add(); `cursors`: all persons, where it is time
  /// to sample them. From one thread only. Does nothing after finish(), and counts ticks that no part can
  /// have.
  void push(std::shared_ptr<const TickDelta> delta, std::vector<Command> commands,
            std::vector<Event> noted = {}, std::shared_ptr<const WorldMoment> part = nullptr,
            std::optional<std::vector<PlayerCursor>> cursors = std::nullopt);
  /// RecordingWriter::wants_part() of the last tick that was written. From any thread.
  PartWish wants_part() const;
  /// Whether another part waits for a world to begin with. From any thread.
  bool wants_start() const;
  /// Begins that part with the world as it stands after the last tick that was pushed, and was renewed
  /// (World::renew). Does nothing unless wants_start(). From the thread of push().
  void begin_again(RecordingStart start);

  /// Waits until that tick, which was pushed or is the start's, is in the file, and survives the end of this
  /// process; or until it is known that this fails, or the recording has ended. From any thread.
  void commit_up_to(Tick tick);

  /// Writes all queued ticks, closes the file and joins the thread. What fails is tried again for
  /// `last_tries_s`; then the error says from where on ticks are not recorded.
  Result<void> finish(double last_tries_s = limits::last_tries_s);

  /// From any thread. Lost are ticks that no part has.
  StoreHealth health() const;
  std::string path() const;        ///< of the last part; from any thread
  uint64_t ticks_written() const;  ///< from any thread
  uint64_t waits() const;          ///< times that push() had to wait; from any thread
  size_t waiting() const;          ///< ticks that are not written yet; from any thread
  Durations commits() const;       ///< how long commits took, failed ones too; from any thread
  RecordingSize size() const;      ///< as of the last commit; from any thread

 private:
  struct State;
  explicit Recorder(std::unique_ptr<State> state);
  static std::unique_ptr<Recorder> start(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
