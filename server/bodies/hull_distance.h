// Distance between two convex hulls by the algorithm of Gilbert, Johnson and Keerthi (1988), tuned for many
// small hulls that move little from tick to tick. Each pair starts from the corners that were nearest in the
// last tick, and mostly ends after one step. Metres.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/base/check.h"

namespace scree {

/// Corners of a hull, turned to the world's axes, relative to its body's centre. Four x, four y and four z
/// lie behind each other, and copies pad the corners to a multiple of four, so that vector instructions can
/// search them.
class HullCorners {
 public:
  /// At least one corner, at most 65,535.
  explicit HullCorners(const std::vector<glm::vec3>& corners);

  size_t size() const { return own_.size(); }
  /// `rotation`: from the body's axes to the world's.
  void turn(const glm::mat3& rotation);
  /// The number of the corner farthest along a direction; the lowest of several.
  uint16_t support(glm::vec3 along) const;
  glm::vec3 corner(uint16_t number) const {
    CHECK_DEBUG(number < own_.size());
    const float* const x = &turned_[number / 4 * 12 + number % 4];
    return {x[0], x[4], x[8]};
  }

 private:
  std::vector<glm::vec3> own_;  ///< in the body's own axes
  std::vector<float> turned_;
};

/// The corners at which the last search of a pair ended; the next one starts there. Corner numbers must be
/// those of the same two hulls.
struct NearestCorners {
  uint32_t count = 0;
  std::array<uint16_t, 3> a{};
  std::array<uint16_t, 3> b{};
};

struct HullDistance {
  enum class Kind : uint8_t { apart, near, overlapping };
  Kind kind = Kind::apart;  ///< apart: by more than the given reach; the other members are not set
  glm::vec3 on_b{0.0F};     ///< near: b's nearest point, relative to b's centre
  glm::vec3 normal{0.0F};   ///< near: unit, from b to a
  float distance_m = 0.0F;  ///< near
};

/// Distance between two hulls, and their nearest points, up to a distance of `reach_m`. `a_from_b`: a's
/// centre relative to b's.
HullDistance distance_between(const HullCorners& a, const HullCorners& b, glm::vec3 a_from_b, float reach_m,
                              NearestCorners& nearest);

}  // namespace scree
