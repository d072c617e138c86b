// Records ticks on a thread of its own, so that the simulation never waits for a disk, unless the disk is
// hopelessly behind: limits::recorder_queue_max ticks may wait, beyond that push() does, and counts it.
//
// When writing fails the recording ends there, playable up to the last commit; the simulation goes on, and
// error() says why.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/store/recording.h"
#include "shared/base/result.h"

namespace scree {

class Recorder {
 public:
  static Result<std::unique_ptr<Recorder>> create(const std::string& path, const RecordingHeader& header);
  /// Finishes.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// The next tick, the first being 1. From one thread only.
  void push(std::shared_ptr<const TickDelta> delta, std::vector<Command> commands);

  /// Writes everything, closes the file, joins the thread. What went wrong since the start, if anything did.
  Result<void> finish();

  /// Why the recording ended before its time. From any thread.
  std::optional<std::string> error() const;
  uint64_t ticks_written() const;
  uint64_t waits() const;  ///< times that push() had to wait

 private:
  struct State;
  explicit Recorder(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
