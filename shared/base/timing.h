// A stopwatch for instrumentation. The simulation never uses its readings.
#pragma once

#include <chrono>

namespace scree {

class Stopwatch {
 public:
  /// Milliseconds since construction or the last call of lap_ms.
  double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed_ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return elapsed_ms;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace scree
