// Where a film is seen from: a fixed place, a path of key frames, round an event, or by the eye of
// somebody who was there.
#pragma once

#include <variant>

#include "client/viewer/pictures/camera_path.h"
#include "shared/base/overloaded.h"
#include "tools/film/eye_shot.h"
#include "tools/film/orbit.h"

namespace scree {

using Shot = std::variant<Camera, CameraPath, Orbit, EyeShot>;

/// `time_s`: from the film's start.
inline Camera camera_at(const Shot& shot, double time_s) {
  return std::visit(Overloaded{[](const Camera& fixed) { return fixed; },
                               [time_s](const auto& moving) { return moving.at(time_s); }},
                    shot);
}

}  // namespace scree
