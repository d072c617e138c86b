// A camera's flight through key frames: a JSON file
//
//   {"keys": [{"time_s": 0, "camera": [x, y, z, yaw, pitch]}, {"time_s": 4, "camera": […]}, …]}
//
// in metres, degrees and seconds, as --camera; times ascend, by limits::path_step_min_s or more. Between keys
// each value follows a cubic Hermite curve whose slopes are those of the chord from the key before to the key
// after (Catmull-Rom for uneven times), so that neither place nor speed jumps. Yaw goes the shorter way round
// from key to key.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "client/render/scene/camera.h"
#include "shared/base/result.h"

namespace scree {

class CameraPath {
 public:
  /// The text of such a file. The error says which key is wrong, and how.
  static Result<CameraPath> parse(const std::string& text);
  static Result<CameraPath> read(const std::string& file);

  /// From the first key to the last.
  double duration_s() const { return keys_.back().time_s; }
  /// `time_s` from the first key on; clamped to the path.
  Camera at(double time_s) const;

 private:
  /// x, y, z in metres, yaw and pitch in radians, yaw unrolled.
  using Values = std::array<double, 5>;
  struct Key {
    double time_s = 0.0;  ///< from the first key on
    Values values{};
  };

  CameraPath() = default;
  Result<void> add(double time_s, const Camera& camera);
  Values slope_at(size_t key) const;

  std::vector<Key> keys_;  ///< at least one
  double start_s_ = 0.0;   ///< the first key's time in the file
};

}  // namespace scree
