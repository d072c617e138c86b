#include "client/viewer/session/way_ahead.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/person/solid_ground.h"
#include "shared/person/walker.h"

namespace scree {
namespace {

/// Sine of the angle, up or down, from which on the eye looks elsewhere than ahead: 25 degrees.
constexpr float steep = 0.42F;
constexpr float ahead_max_m = 1.0F, step_m = 0.1F;
/// Over the feet, what one walks over anyway.
constexpr float over_m = 0.1F;
/// Height of the hole's middle over the feet, with which a crater of the usual size has room for a body.
constexpr float middle_m = 1.1F;
/// The greatest distance of the middle from what is to go, in radii: a crater leaves a border of its ball.
constexpr float off_in_radii = 0.4F;

/// The deepest contact of a body there with rock; nothing: it is free.
std::optional<glm::vec3> contact_m(glm::vec3 feet_m, SolidGround& ground) {
  constexpr int spheres = 5;
  constexpr float apart_m = (Walker::height_m - 2.0F * Walker::radius_m) / (spheres - 1);
  std::optional<glm::vec3> contact;
  float deepest_m = Walker::skin_m;
  for (int i = 0; i < spheres; ++i) {
    const glm::vec3 middle =
        feet_m + glm::vec3(0.0F, Walker::radius_m + apart_m * static_cast<float>(i), 0.0F);
    const WalkGround::Touch touch = ground.rock(middle);
    const float deep_m = Walker::radius_m - touch.distance_m;
    if (deep_m <= deepest_m) continue;
    deepest_m = deep_m;
    contact = middle - touch.away * touch.distance_m;
  }
  return contact;
}

}  // namespace

std::optional<glm::vec3> middle_of_way(const Field& field, glm::vec3 feet_m, glm::vec3 direction,
                                       float radius_m) {
  if (std::abs(direction.y) > steep) return std::nullopt;
  const glm::vec3 ahead = glm::normalize(glm::vec3(direction.x, 0.0F, direction.z));
  SolidGround ground(field, feet_m);
  for (int i = 1; static_cast<float>(i) * step_m <= ahead_max_m; ++i) {
    const float far_m = static_cast<float>(i) * step_m;
    const auto contact = contact_m(feet_m + ahead * far_m + glm::vec3(0.0F, over_m, 0.0F), ground);
    if (!contact) continue;
    const glm::vec3 middle = feet_m + ahead * (far_m + Walker::radius_m) + glm::vec3(0.0F, middle_m, 0.0F);
    const glm::vec3 off = middle - *contact;
    const float most_m = off_in_radii * radius_m, away_m = glm::length(off);
    return away_m > most_m ? *contact + off * (most_m / away_m) : middle;
  }
  return std::nullopt;
}

}  // namespace scree
