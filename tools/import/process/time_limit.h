// Ends the program at a limit of time. What work a mesh or a volume makes cannot be told by its size, and it
// is done in places that know of no limit: a signal reaches all of them.
#pragma once

#include <chrono>
#include <string>

namespace scree {

/// One at a time in a process. Children that are forked meanwhile have no limit.
class TimeLimit {
 public:
  /// After `time` the program says `words` on the standard error, removes the file `unfinished`, and exits
  /// with 1.
  TimeLimit(std::chrono::milliseconds time, const std::string& words, const std::string& unfinished);
  /// The time does not matter any more.
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
};

}  // namespace scree
