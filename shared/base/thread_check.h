// Tells whether calls come from one thread: for objects that are made on one thread, used on another, and not
// safe to use from both.
#pragma once

#include <atomic>
#include <thread>

namespace scree {

class ThreadCheck {
 public:
  /// Whether this thread is the one of the first call. Safe to call from any thread.
  bool is_the_same() {
    std::thread::id none{};
    const std::thread::id caller = std::this_thread::get_id();
    return owner_.compare_exchange_strong(none, caller) || none == caller;
  }

 private:
  std::atomic<std::thread::id> owner_{};
};

}  // namespace scree
