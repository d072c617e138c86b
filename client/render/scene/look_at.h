// A camera by what it looks at.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "client/render/scene/camera.h"

namespace scree {

/// From one place at another one, which is not straight above or below it.
inline Camera look_at(glm::vec3 eye_m, glm::vec3 at_m) {
  const glm::vec3 way = glm::normalize(at_m - eye_m);
  return {eye_m, std::atan2(-way.x, -way.z), std::asin(way.y)};
}

}  // namespace scree
