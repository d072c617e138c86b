// Records a camera's flight as key frames of a CameraPath. No window.
#pragma once

#include <string>
#include <vector>

#include "client/render/scene/camera.h"

namespace scree {

class PathRecorder {
 public:
  /// Seconds between two keys: a hand's turns are kept, a file of a minute is 240 lines.
  static constexpr double step_s = 0.25;

  /// The camera at some time of a steady clock; keeps one every step_s. False when the path is as long as a
  /// path may be (limits::path_keys_max, path_duration_max_s): nothing more is kept.
  bool add(double now_s, const Camera& camera);
  double duration_s() const;
  /// As CameraPath::parse() takes it; at least one key.
  std::string text() const;

 private:
  struct Key {
    double time_s = 0.0;
    Camera camera;
  };
  std::vector<Key> keys_;
  double begun_s_ = 0.0;
};

}  // namespace scree
