// A file of events as JSON Lines, appended to by a thread of its own, so that nobody waits for the disk. What
// does not fit into the queue, and what cannot be written, is lost and counted; the next lines are tried
// anew, so that a disk that has room again gets them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shared/base/result.h"

namespace scree {

class EventLog {
 public:
  /// Opens the file, or makes it: what it has stays.
  static Result<std::unique_ptr<EventLog>> open(const std::string& path);
  /// Writes what waits.
  ~EventLog();
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  /// Queues a line, without its end. Never waits. From any thread.
  void push(std::string line);

  struct Status {
    uint64_t written = 0;                ///< lines
    uint64_t lost = 0;                   ///< lines
    std::optional<std::string> error{};  ///< of the last write, when that failed
  };
  /// From any thread.
  Status status() const;
  /// Waits until all that was pushed is written or lost.
  void flush();

 private:
  struct State;
  explicit EventLog(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace scree
