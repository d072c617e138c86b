// Tells whether calls come from one thread: for objects that are made on one thread, used on another, and not
// safe to use from both. Ownership passes on when the owner lets go of it.
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

  /// The thread of the next call becomes the owner, and sees all that this one did. False, and nothing
  /// changes, when another thread is the owner.
  [[nodiscard]] bool release() {
    std::thread::id owner = std::this_thread::get_id();
    return owner_.compare_exchange_strong(owner, std::thread::id{}) || owner == std::thread::id{};
  }

 private:
  std::atomic<std::thread::id> owner_{};
};

}  // namespace scree
