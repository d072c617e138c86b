// A file of events as JSON Lines, appended to by a thread of its own, so that nobody waits for the disk. It
// consists of whole lines: what a crash or a full disk left of one is cut off. A write that fails is tried
// again after growing pauses; what does not fit into the queue meanwhile is lost and counted. A file that was
// moved or removed is made anew under its name, as programs expect that rotate logs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "server/store/retry_pause.h"
#include "shared/base/result.h"

namespace scree {

class EventLog {
 public:
  /// Opens the file, or makes it: what it has stays, but for half a line of ours at its end.
  static Result<std::unique_ptr<EventLog>> open(const std::string& path);
  /// Calls finish().
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  /// Queues a line, without its end. Never waits. From any thread.
  void push(std::string line);

  struct Status {
    uint64_t written = 0;  ///< lines
    StoreHealth health;    ///< lost are lines
  };
  /// From any thread.
  Status status() const;
  /// Waits until all that was pushed is written, or a write failed.
  void flush();
  /// Writes what waits, and tries once more where that fails; then the error says how many lines are lost.
  /// The owner's last call.
  Result<void> finish();

 private:
  struct State;
  explicit EventLog(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
