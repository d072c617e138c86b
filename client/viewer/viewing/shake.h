// How blows shake the eye: by their energy and how far away they are. Only for the eye: aiming goes on as if
// nothing shook. Time is an argument (seconds).
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "client/render/scene/camera.h"
#include "client/viewer/events/piece_event.h"

namespace scree {

class Shake {
 public:
  /// What happened since the last call. `now_s`: never backwards.
  void add(std::span<const PieceEvent> events, glm::vec3 eye_m, double now_s);
  /// Nothing shakes any more.
  void end() { strength_ = 0.0F; }
  /// 0 (still) to 1 (as much as it ever does).
  float strength(double now_s) const;
  /// The camera as it is shaken at that time; nearby times are near.
  Camera of(const Camera& camera, double now_s) const;

 private:
  float strength_ = 0.0F;
  double since_s_ = 0.0;
};

}  // namespace scree
