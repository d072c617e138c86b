// The points that represent a body's surface, turned to the body's pose. Metres.
#pragma once

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "server/colliders/sound_values.h"
#include "shared/base/check.h"
#include "shared/field/piece.h"

namespace scree {

class BodyPoints {
 public:
  /// Relative to the centre of mass, in the body's own axes; at least one.
  explicit BodyPoints(std::vector<glm::vec3> own_m) : own_m_(std::move(own_m)), offsets_m_(own_m_.size()) {
    CHECK(!own_m_.empty());
  }

  void turn(const Pose& pose) {
    CHECK_DEBUG(is_sound(pose));
    const glm::mat3 turned = glm::mat3_cast(pose.rotation);
    glm::vec3 lo(0.0F), hi(0.0F);
    for (size_t i = 0; i < own_m_.size(); ++i) {
      offsets_m_[i] = turned * own_m_[i];
      lo = glm::min(lo, offsets_m_[i]);
      hi = glm::max(hi, offsets_m_[i]);
    }
    lo_m_ = pose.position_m + lo;
    hi_m_ = pose.position_m + hi;
  }

  int count() const { return static_cast<int>(offsets_m_.size()); }
  /// A point's offset from the centre of mass, in the world's axes, as of the last turn().
  glm::vec3 offset_m(int point) const {
    CHECK_DEBUG(point >= 0 && point < count());
    return offsets_m_[static_cast<size_t>(point)];
  }
  /// Bounds of the points and the centre of mass in the world, as of the last turn().
  glm::vec3 lo_m() const { return lo_m_; }
  glm::vec3 hi_m() const { return hi_m_; }

 private:
  std::vector<glm::vec3> own_m_;
  std::vector<glm::vec3> offsets_m_;
  glm::vec3 lo_m_{0.0F};
  glm::vec3 hi_m_{0.0F};
};

}  // namespace scree
