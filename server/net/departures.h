// Sessions that cannot go on any more, on their way to the simulation, which drops what they still have
// waiting (LeaveRequest). Only those that have asked for something are told; none is lost while the queue of
// commands is full. Not thread-safe.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "server/net/command_queue.h"

namespace scree {

class Departures {
 public:
  explicit Departures(CommandQueue& commands) : commands_(commands) {}

  /// A request of the session is in the queue of commands.
  void asked(uint64_t session) { askers_.insert(session); }
  /// The session cannot go on.
  void gone(uint64_t session) {
    if (askers_.erase(session) != 0) waiting_.push_back(session);
    tell();
  }
  /// Tells those for which the queue had no room. Call a few times a second.
  void tell() {
    size_t told = 0;
    while (told < waiting_.size() && commands_.push({waiting_[told], 0, LeaveRequest{}})) ++told;
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(told));
  }

 private:
  CommandQueue& commands_;
  std::unordered_set<uint64_t> askers_;  ///< of the sessions that may still go on
  std::vector<uint64_t> waiting_;        ///< to be told, in order
};

}  // namespace scree
