// The queue of commands from the network to the simulation. Bounded: push() refuses a command that does not
// fit, and never waits. Safe to use from any thread.
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "server/command/command.h"
#include "server/net/limits.h"

namespace scree {

class CommandQueue {
 public:
  explicit CommandQueue(size_t commands_max = limits::commands_waiting_max) : commands_max_(commands_max) {}

  /// False when the queue is full.
  [[nodiscard]] bool push(const Command& command) {
    const std::scoped_lock lock(mutex_);
    if (commands_.size() >= commands_max_) return false;
    commands_.push_back(command);
    return true;
  }

  /// Takes all commands out, in order of arrival.
  std::vector<Command> drain() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(commands_, {});
  }

  size_t commands_max() const { return commands_max_; }

 private:
  const size_t commands_max_;
  std::mutex mutex_;
  std::vector<Command> commands_;
};

}  // namespace scree
