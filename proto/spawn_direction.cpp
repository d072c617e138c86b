#include "proto/spawn_direction.h"

#include <algorithm>
#include <cmath>

namespace scree {

namespace {

constexpr double degrees_per_radian = 57.29577951308232;

}  // namespace

Spawn spawn_looking_at(glm::vec3 eye_m, glm::vec3 at_m) {
  const double x = static_cast<double>(at_m.x - eye_m.x), y = static_cast<double>(at_m.y - eye_m.y),
               z = static_cast<double>(at_m.z - eye_m.z);
  Spawn spawn{eye_m, static_cast<float>(std::atan2(-x, -z) * degrees_per_radian),
              static_cast<float>(std::atan2(y, std::hypot(x, z)) * degrees_per_radian)};
  spawn.pitch_degrees = std::clamp(spawn.pitch_degrees, -spawn_pitch_max_degrees, spawn_pitch_max_degrees);
  return rounded(spawn);
}

glm::vec3 ahead_of(const Spawn& spawn, float metres) {
  const double yaw = static_cast<double>(spawn.yaw_degrees) / degrees_per_radian;
  return spawn.eye_m -
         metres * glm::vec3(static_cast<float>(std::sin(yaw)), 0.0F, static_cast<float>(std::cos(yaw)));
}

}  // namespace scree
