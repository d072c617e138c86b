#include "server/world/ejecta.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/base/limits.h"
#include "shared/base/roots.h"

namespace scree {

namespace {

constexpr float gravity_m_s2 = 9.81F;
/// Speed in roots of gravity times radius. With less, what is thrown falls back: rubble takes 1.6 times the
/// room of rock. With more, nothing does, and stones fly out of sight. With this, half of the depth or more
/// and a quarter of the volume or more stay open (tests/props/crater_test.cpp).
constexpr float speed_by_weight = 1.9F;
/// 1/μ − 1 for rock: μ is 0.55.
constexpr float exponent_beyond_1 = 0.82F;
/// n₂, where the law's speed is 0, in radii.
constexpr float stays_radii = 1.3F;
/// What is nearer to the charge, in radii, gets no more: 4 % of a ball would fly out of sight.
constexpr float nearest_radii = 0.5F;
/// Depth of the place away from which all flies, in radii.
constexpr float source_radii = 1.5F;

}  // namespace

float ejecta_speed_m_s(float radius_m) {
  return speed_by_weight * std::sqrt(gravity_m_s2 * radius_m);
}

EjectedMotion ejected(const Burst& burst, glm::vec3 open_side, glm::vec3 place_m) {
  const glm::vec3 off_m = place_m - burst.centre_m;
  const float radii = std::clamp(std::sqrt(glm::dot(off_m, off_m)) / burst.radius_m, nearest_radii, 1.0F);
  const float by_distance = std::sqrt(1.0F - radii / stays_radii) / (radii * power(radii, exponent_beyond_1));
  const glm::vec3 away_m = off_m + source_radii * burst.radius_m * open_side;
  return {.direction = away_m / std::max(std::sqrt(glm::dot(away_m, away_m)), 0.01F),
          .speed_m_s = std::min(burst.speed_m_s * by_distance, limits::blast_speed_max_m_s)};
}

}  // namespace scree
