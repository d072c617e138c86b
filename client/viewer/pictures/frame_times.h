// Measured times of frames, for --timedemo.
#pragma once

#include <string>
#include <vector>

namespace scree {

/// Milliseconds of one frame.
struct FrameTime {
  double update_ms = 0.0;  ///< messages applied, work shown and begun
  double draw_ms = 0.0;    ///< from the first GL call until the GPU has finished
  double frame_ms = 0.0;   ///< both
};

/// The measurements and their conditions.
struct TimeDemo {
  std::string path;    ///< file
  std::string method;  ///< that drew
  std::string driver;
  int width = 0;
  int height = 0;
  std::vector<FrameTime> frames;
};

/// One line: method, driver, width, height, path, frames (their number); of frame_ms, update_ms and draw_ms
/// median, p99, worst and mean; each_frame_ms. `demo` has at least one frame.
std::string to_json(const TimeDemo& demo);

}  // namespace scree
