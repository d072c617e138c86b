// Distance between two convex hulls: the algorithm of Gilbert, Johnson and Keerthi (1988), made for many
// small hulls that move little from tick to tick. Each pair starts from the corners that were nearest in the
// last tick, and mostly is done after one look. Metres.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace scree {

/// Corners of a hull, turned to the world's axes, relative to its body's centre. Coordinates apart and padded
/// to a multiple of four with copies, so that they are searched in vectors.
class HullCorners {
 public:
  /// At least one corner, at most 65,535.
  explicit HullCorners(std::vector<glm::vec3> corners);

  void turn(const glm::mat3& rotation);
  /// The number of the corner farthest along a direction; the lowest of several.
  uint16_t support(glm::vec3 along) const;
  glm::vec3 corner(uint16_t number) const { return {x_[number], y_[number], z_[number]}; }

 private:
  std::vector<glm::vec3> own_;  ///< in the body's own axes
  std::vector<float> x_, y_, z_;
};

/// Where the last search of a pair ended. Any content is safe for the same two hulls.
struct NearestCorners {
  uint32_t count = 0;
  std::array<uint16_t, 3> a{};
  std::array<uint16_t, 3> b{};
};

struct HullDistance {
  enum class Kind : uint8_t { apart, near, overlapping };
  Kind kind = Kind::apart;  ///< apart: more than the reach asked for; nothing else is known
  glm::vec3 on_b{0.0F};     ///< near: b's nearest point, relative to b's centre
  glm::vec3 normal{0.0F};   ///< near: unit, from b to a
  float distance_m = 0.0F;  ///< near
};

/// `a_from_b`: a's centre relative to b's.
HullDistance distance_between(const HullCorners& a, const HullCorners& b, glm::vec3 a_from_b, float reach_m,
                              NearestCorners& nearest);

}  // namespace scree
