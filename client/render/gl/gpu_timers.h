// Measures the GPU's time for the parts of a frame: timestamps before and after each, read some frames later,
// so that no thread waits for the GPU. Needs the GL context current, the destructor too.
//
// OpenGL 3.3 has timestamps; OpenGL ES with EXT_disjoint_timer_query. Elsewhere nothing is measured.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "shared/base/trace.h"

namespace scree {

struct GpuTime {
  std::string_view name;  ///< a literal
  double ms = 0.0;
};

class GpuTimers {
 public:
  /// Frames under way at once; the GPU lags at most so far behind.
  static constexpr size_t frames = 4;
  /// Parts of one frame; more are not measured.
  static constexpr size_t parts_max = 16;

  GpuTimers();
  ~GpuTimers();
  GpuTimers(const GpuTimers&) = delete;
  GpuTimers& operator=(const GpuTimers&) = delete;

  bool available() const { return available_; }
  /// Reads the finished timestamps, and begins the next frame. `trace` may be null.
  void begin_frame(Trace* trace);

  /// Measures the GL commands between its construction and its end. `timers` may be null.
  class Part {
   public:
    Part(GpuTimers* timers, std::string_view name);
    ~Part();
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

   private:
    GpuTimers* timers_;
    size_t at_ = 0;
  };

  /// Times of the newest finished frame, in the order in which its parts began.
  const std::vector<GpuTime>& latest() const { return latest_; }

 private:
  struct Queries;
  struct Frame {
    std::vector<std::string_view> names;
  };

  void collect(size_t frame, Trace* trace);

  bool available_ = false;
  std::unique_ptr<Queries> queries_;
  std::array<Frame, frames> frames_;
  size_t current_ = 0;
  std::vector<GpuTime> latest_;
  Trace::Clock::time_point epoch_;  ///< the CPU's time at gpu_epoch_ns_ of the GPU's clock
  int64_t gpu_epoch_ns_ = 0;
};

}  // namespace scree
