// The clock of a simulated link: the real one, or a test's.
#pragma once

#include <functional>

namespace scree {

class LinkClock {
 public:
  virtual ~LinkClock() = default;
  /// Seconds; never goes back.
  virtual double now_s() const = 0;
  /// Calls once, at that time or soon after it, never from within this call; a later call of wake_at() takes
  /// the place of the one before.
  virtual void wake_at(double time_s, std::function<void()> wake) = 0;
  virtual void cancel() = 0;
};

}  // namespace scree
