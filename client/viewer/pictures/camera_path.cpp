#include "client/viewer/pictures/camera_path.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "client/viewer/base/camera_text.h"
#include "client/viewer/base/files.h"
#include "client/viewer/base/json_depth.h"
#include "client/viewer/base/limits.h"

namespace scree {
namespace {

using Json = nlohmann::json;

/// The fields of one key, or an error that names the wrong one.
Result<std::pair<double, Camera>> key_of(const Json& json) {
  if (!json.is_object() || !json.contains("time_s") || !json["time_s"].is_number())
    return fail("it has no number time_s");
  const Json camera = json.value("camera", Json());
  std::array<float, 5> values{};
  if (!camera.is_array() || camera.size() != values.size() || !std::ranges::all_of(camera, &Json::is_number))
    return fail("its camera is not [x, y, z, yaw, pitch]");
  std::ranges::transform(camera, values.begin(), [](const Json& value) { return value.get<float>(); });
  const Result<Camera> place = camera_of(values);
  if (!place) return fail(place.error().message);
  return std::pair(json["time_s"].get<double>(), *place);
}

}  // namespace

Result<CameraPath> CameraPath::parse(const std::string& text) {
  TRY(check_json_depth(text));
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return fail("it is not JSON");
  const Json keys = json.is_object() ? json.value("keys", Json()) : Json();
  if (!keys.is_array() || keys.empty()) return fail("it has no list of keys");
  if (keys.size() > limits::path_keys_max)
    return fail("it has over " + std::to_string(limits::path_keys_max) + " keys (limits.path_keys_max)");
  CameraPath path;
  for (const Json& entry : keys) {
    const auto wrong = [&](const std::string& why) {
      return fail("key " + std::to_string(path.keys_.size() + 1) + ": " + why);
    };
    const auto key = key_of(entry);
    if (!key) return wrong(key.error().message);
    if (Result<void> added = path.add(key->first, key->second); !added) return wrong(added.error().message);
  }
  if (path.duration_s() > limits::path_duration_max_s)
    return fail("it is longer than " + std::to_string(static_cast<int>(limits::path_duration_max_s)) +
                " s (limits.path_duration_max_s)");
  return path;
}

Result<CameraPath> CameraPath::read(const std::string& file) {
  const Result<std::string> text = read_text(file);
  if (!text) return fail("--path: " + text.error().message);
  Result<CameraPath> path = parse(*text);
  if (!path) return fail("--path: " + file + ": " + path.error().message);
  return path;
}

Result<void> CameraPath::add(double time_s, const Camera& camera) {
  // From the first key on: of large numbers of seconds, sums would be rounded.
  if (keys_.empty()) start_s_ = time_s;
  time_s -= start_s_;
  if (!keys_.empty() && !(time_s - keys_.back().time_s >= limits::path_step_min_s))
    return fail("its time is not " + std::to_string(limits::path_step_min_s) +
                " s or more after the time before it (limits.path_step_min_s)");
  double yaw = static_cast<double>(camera.yaw);
  if (!keys_.empty()) {
    const double before = keys_.back().values[3];
    yaw = before + std::remainder(yaw - before, 2.0 * std::numbers::pi);
  }
  keys_.push_back({time_s,
                   {static_cast<double>(camera.eye_m.x), static_cast<double>(camera.eye_m.y),
                    static_cast<double>(camera.eye_m.z), yaw, static_cast<double>(camera.pitch)}});
  return {};
}

CameraPath::Values CameraPath::slope_at(size_t key) const {
  const Key& before = keys_[key == 0 ? 0 : key - 1];
  const Key& after = keys_[std::min(key + 1, keys_.size() - 1)];
  Values slope{};
  for (size_t i = 0; i < slope.size(); ++i)
    slope[i] = (after.values[i] - before.values[i]) / (after.time_s - before.time_s);
  return slope;
}

Camera CameraPath::at(double time_s) const {
  const double time = std::clamp(time_s, 0.0, duration_s());
  const auto after = std::ranges::upper_bound(keys_, time, {}, &Key::time_s);
  Values values = keys_.back().values;
  if (after != keys_.end()) {
    const auto i = static_cast<size_t>(after - keys_.begin()) - 1;
    const Key& from = keys_[i];
    const Key& to = keys_[i + 1];
    const double span = to.time_s - from.time_s;
    const double t = (time - from.time_s) / span;
    const Values leave = slope_at(i);
    const Values arrive = slope_at(i + 1);
    for (size_t k = 0; k < values.size(); ++k) {
      const double turn = to.values[k] - from.values[k];
      values[k] = from.values[k] + t * t * (3.0 - 2.0 * t) * turn +
                  t * (1.0 - t) * span * ((1.0 - t) * leave[k] - t * arrive[k]);
    }
  }
  Camera camera;
  camera.eye_m = glm::vec3(values[0], values[1], values[2]);
  camera.yaw = static_cast<float>(values[3]);
  camera.pitch = std::clamp(static_cast<float>(values[4]), -placed_pitch_max, placed_pitch_max);
  return camera;
}

}  // namespace scree
