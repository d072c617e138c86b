// The queue of commands from the network to the simulation. Bounded: push() refuses a command that does not
// fit, and never waits. A party may have as many in it as there are places left, and at least its even share,
// so that nobody keeps the others out; so there may be twice as many as places, at most. Safe to use from any
// thread.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <unordered_map>
#include <utility>
#include <vector>

#include "server/command/command.h"
#include "server/net/limits.h"

namespace scree {

class CommandQueue {
 public:
  explicit CommandQueue(size_t commands_max = limits::commands_waiting_max) : commands_max_(commands_max) {}

  /// False when the queue is full, or full for this party.
  [[nodiscard]] bool push(const Command& command) {
    const std::scoped_lock lock(mutex_);
    size_t& own = by_party_[party_of(command)];
    const size_t left = commands_max_ - std::min(commands_max_, commands_.size());
    const size_t share = std::max<size_t>(1, commands_max_ / by_party_.size());
    if (own >= std::max(left, share)) return false;
    ++own;
    commands_.push_back(command);
    return true;
  }

  /// Takes all commands out, in order of arrival.
  std::vector<Command> drain() {
    const std::scoped_lock lock(mutex_);
    by_party_.clear();
    return std::exchange(commands_, {});
  }

  size_t commands_max() const { return commands_max_; }

 private:
  const size_t commands_max_;
  std::mutex mutex_;
  std::vector<Command> commands_;
  std::unordered_map<uint64_t, size_t> by_party_;  ///< how many of them
};

}  // namespace scree
