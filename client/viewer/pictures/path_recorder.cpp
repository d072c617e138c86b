#include "client/viewer/pictures/path_recorder.h"

#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "client/viewer/base/limits.h"
#include "shared/base/check.h"

namespace scree {

bool PathRecorder::add(double now_s, const Camera& camera) {
  if (keys_.empty()) begun_s_ = now_s;
  const double time_s = now_s - begun_s_;
  if (keys_.size() >= limits::path_keys_max || time_s > limits::path_duration_max_s) return false;
  if (keys_.empty() || time_s >= keys_.back().time_s + step_s) keys_.push_back({time_s, camera});
  return true;
}

double PathRecorder::duration_s() const {
  return keys_.empty() ? 0.0 : keys_.back().time_s;
}

std::string PathRecorder::text() const {
  CHECK(!keys_.empty());
  nlohmann::ordered_json keys = nlohmann::ordered_json::array();
  for (const auto& [time_s, camera] : keys_)
    keys.push_back({{"time_s", time_s},
                    {"camera",
                     {camera.eye_m.x, camera.eye_m.y, camera.eye_m.z, glm::degrees(camera.yaw),
                      glm::degrees(camera.pitch)}}});
  return nlohmann::ordered_json{{"keys", keys}}.dump(1) + "\n";
}

}  // namespace scree
