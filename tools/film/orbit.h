// A camera that goes round an event.
#pragma once

#include <glm/vec3.hpp>

#include "client/render/scene/camera.h"
#include "proto/event.h"
#include "shared/field/field.h"

namespace scree {

class Orbit {
 public:
  /// An orbit round an event that has a place, for so many seconds. It is as far away as the event's volume
  /// asks for, and as low as rock leaves the event in sight. Where the orbit is not a whole one, it is on the
  /// side with the best view. `field` is the terrain as it stands before the event.
  static Orbit around(const Event& event, Field& field, double seconds);

  /// `time_s`: from the film's start.
  Camera at(double time_s) const;
  float distance_m() const { return distance_m_; }

 private:
  glm::vec3 place_m_{0.0F};
  float distance_m_ = 1.0F;
  float height_ = 0.0F;  ///< angle above the horizon, radians
  float start_ = 0.0F;   ///< angle from the z axis to the x axis, radians
};

}  // namespace scree
