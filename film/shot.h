// Where a film is seen from: a fixed place, a path of key frames, or round an event.
#pragma once

#include <variant>

#include "client/viewer/pictures/camera_path.h"
#include "film/orbit.h"
#include "shared/base/overloaded.h"

namespace scree {

using Shot = std::variant<Camera, CameraPath, Orbit>;

/// `time_s`: from the film's start.
inline Camera camera_at(const Shot& shot, double time_s) {
  return std::visit(Overloaded{[](const Camera& fixed) { return fixed; },
                               [time_s](const auto& moving) { return moving.at(time_s); }},
                    shot);
}

}  // namespace scree
