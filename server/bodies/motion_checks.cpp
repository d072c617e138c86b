#include "server/bodies/motion_checks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "server/bodies/limits.h"
#include "server/colliders/sound_values.h"
#include "shared/base/limits.h"

namespace scree {

Result<void> refuse_body(PieceId id, const char* what) {
  return fail("body " + std::to_string(id) + ": " + what);
}

Result<void> check_shape(PieceId id, const BodyShape& shape) {
  const glm::mat3& inertia = shape.inertia_kg_m2;
  const auto sound = [](const std::vector<glm::vec3>& points) {
    return std::ranges::all_of(points, [](glm::vec3 p) { return is_sound(p); });
  };
  const auto hull = [&](const std::vector<glm::vec3>& points) { return points.size() >= 4 && sound(points); };
  const bool is_rounded = !shape.part_radii_m.empty();
  if (is_rounded && shape.part_radii_m.size() != shape.parts_m.size())
    return refuse_body(id, "not every part has a radius");
  const auto part = [&](const std::vector<glm::vec3>& points) {
    return is_rounded ? !points.empty() && sound(points) : hull(points);
  };
  if (!hull(shape.hull_m) || !sound(shape.surface_m) || !std::ranges::all_of(shape.parts_m, part))
    return refuse_body(id, "a hull of fewer than four corners, or without a place");
  if (!(shape.mass_kg >= limits::restored_mass_min_kg && shape.mass_kg <= limits::restored_mass_max_kg))
    return refuse_body(id, "its mass is none that a piece has");
  for (int i = 0; i < 3; ++i)
    if (!is_sound(inertia[i]) || !(inertia[i][i] > 0.0F))
      return refuse_body(id, "its inertia is not positive");
  if (inertia != glm::transpose(inertia)) return refuse_body(id, "its inertia is not symmetric");
  if (!(shape.friction >= 0.0F) || !std::isfinite(shape.friction))
    return refuse_body(id, "its friction is negative or no number");
  return {};
}

Result<void> check_motion(const BodyMotion& motion) {
  const auto& rows = motion.basis;
  const auto is_across = [&](int a, int b) {
    return std::abs(glm::dot(rows[static_cast<size_t>(a)], rows[static_cast<size_t>(b)])) < 2e-3F;
  };
  const bool turned = is_unit(rows[0]) && is_unit(rows[1]) && is_unit(rows[2]) && is_across(0, 1) &&
                      is_across(1, 2) && is_across(2, 0) &&
                      glm::dot(glm::cross(rows[0], rows[1]), rows[2]) > 0.0F;
  if (!turned) return refuse_body(motion.id, "its rotation is none");
  const glm::vec3 at = motion.origin_m;
  if (!(std::abs(at.x) <= limits::world_half_width_m && std::abs(at.y) <= limits::world_half_height_m &&
        std::abs(at.z) <= limits::world_half_width_m))
    return refuse_body(motion.id, "it lies outside the world");
  if (!is_sound(motion.velocity_m_s) || !is_sound(motion.spin_rad_s))
    return refuse_body(motion.id, "its speed is not a number");
  const bool moves = motion.velocity_m_s != glm::vec3(0.0F) || motion.spin_rad_s != glm::vec3(0.0F);
  if (motion.frozen && (moves || motion.thawed)) return refuse_body(motion.id, "it is frozen, and moves");
  return {};
}

}  // namespace scree
