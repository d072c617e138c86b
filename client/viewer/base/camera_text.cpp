#include "client/viewer/base/camera_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "shared/base/limits.h"

namespace scree {
namespace {

constexpr float radians_per_degree = 0.01745329F;

}  // namespace

Result<Camera> camera_of(const std::array<float, 5>& values) {
  if (!std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
    return fail("x, y, z, yaw and pitch must be numbers");
  Camera camera;
  camera.eye_m = {values[0], values[1], values[2]};
  camera.yaw = values[3] * radians_per_degree;
  camera.pitch = std::clamp(values[4] * radians_per_degree, -placed_pitch_max, placed_pitch_max);
  const glm::vec3 away = glm::abs(camera.eye_m);
  if (std::max(away.x, away.z) > limits::world_half_width_m || away.y > limits::world_half_height_m)
    return fail("the place is outside the world (limits.world_half_width_m, world_half_height_m)");
  return camera;
}

Result<Camera> camera_of(const Spawn& spawn) {
  return camera_of({spawn.eye_m.x, spawn.eye_m.y, spawn.eye_m.z, spawn.yaw_degrees, spawn.pitch_degrees});
}

std::string camera_text(const Camera& camera) {
  // A yaw that went round several times is told as one within half a turn.
  const double degrees = static_cast<double>(glm::degrees(camera.yaw));
  const double yaw = std::remainder(degrees, 360.0);
  char text[128];
  std::snprintf(text, sizeof text, "%.2f,%.2f,%.2f,%.1f,%.1f", static_cast<double>(camera.eye_m.x),
                static_cast<double>(camera.eye_m.y), static_cast<double>(camera.eye_m.z), yaw,
                static_cast<double>(glm::degrees(camera.pitch)));
  return text;
}

// Without streams, which would be a tenth of the page's code.
Result<Camera> parse_camera(const std::string& text) {
  std::array<float, 5> values{};
  const char* at = text.c_str();
  for (size_t i = 0; i < values.size(); ++i) {
    if (i > 0) ++at;  // the comma
    char* end = nullptr;
    values[i] = std::strtof(at, &end);
    const bool goes_on = i + 1 < values.size();
    if (end == at || (goes_on && *end != ','))
      return fail("'" + text + "' is not a camera; write x,y,z,yaw,pitch (metres, degrees)");
    at = end;
  }
  if (at != text.c_str() + text.size()) return fail("'" + text + "' has more than x,y,z,yaw,pitch");
  const Result<Camera> place = camera_of(values);
  if (!place) return fail("'" + text + "': " + place.error().message);
  return place;
}

}  // namespace scree
