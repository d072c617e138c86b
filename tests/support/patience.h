// How long tests wait for another thread or process.
#pragma once

#include <chrono>
#include <thread>

namespace scree {

/// Far longer than any wait takes, even under a sanitizer and beside other tests.
inline constexpr std::chrono::seconds patience{60};

/// Between two looks at what another thread does, which may need this one's core.
inline void wait_a_moment() {
  std::this_thread::sleep_for(std::chrono::microseconds(200));
}

/// Since when so many seconds are over: what a test expects before that may not be so on a machine that stood
/// still, and the test is skipped.
class Within {
 public:
  explicit Within(double seconds)
      : end_(std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds)) {}
  bool over() const { return std::chrono::steady_clock::now() >= end_; }

 private:
  std::chrono::time_point<std::chrono::steady_clock, std::chrono::duration<double>> end_;
};

}  // namespace scree
