#include "server/bodies/free_way.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/bodies/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Points that are looked at: every so many-th of the body's.
std::vector<glm::vec3> some_points_m(const Body& body) {
  const size_t stride = (body.points_m.size() + limits::free_way_points - 1) / limits::free_way_points;
  std::vector<glm::vec3> points;
  for (size_t i = 0; i < body.points_m.size(); i += stride)
    points.push_back(from_bullet(body.rigid->getWorldTransform() * to_bullet(body.points_m[i])));
  return points;
}

bool is_in_rock(const Field& field, glm::vec3 p_m) {
  return sample(field, p_m / field.source().voxel_size_m).distance_voxels < 0.0F;
}

/// The gradient's direction first, where there is one, then up, and the others by their number.
std::vector<glm::vec3> directions_from(const Field& field, const std::vector<glm::vec3>& points_m) {
  std::vector<glm::vec3> directions;
  glm::vec3 outward(0.0F);
  for (const glm::vec3& p : points_m) {
    const FieldSample at = sample(field, p / field.source().voxel_size_m);
    if (at.distance_voxels < 0.0F) outward += at.gradient;
  }
  if (const float length = std::sqrt(glm::dot(outward, outward)); length > 1e-3F)
    directions.push_back(outward / length);
  directions.emplace_back(0.0F, 1.0F, 0.0F);
  for (int x = -1; x <= 1; ++x)
    for (int y = 1; y >= -1; --y)
      for (int z = -1; z <= 1; ++z) {
        const glm::vec3 along(x, y, z);
        const float length2 = glm::dot(along, along);
        if (length2 > 0.0F) directions.push_back(along / std::sqrt(length2));
      }
  return directions;
}

}  // namespace

bool is_sunk(const Body& body, const Field& field) {
  if (body.nature().is_piece() || !body.meets_terrain() || body.frozen) return false;
  if (!is_in_rock(field, from_bullet(body.rigid->getWorldTransform().getOrigin()))) return false;
  const std::vector<glm::vec3> points = some_points_m(body);
  const auto inside = std::ranges::count_if(points, [&](glm::vec3 p) { return is_in_rock(field, p); });
  return 2 * static_cast<size_t>(inside) > points.size();
}

std::optional<glm::vec3> free_way(const Body& body, const Field& field) {
  const std::vector<glm::vec3> points = some_points_m(body);
  const std::vector<glm::vec3> directions = directions_from(field, points);
  const float most_m = 2.0F * body.reach_m;
  const float step_m = std::max(0.5F * field.source().voxel_size_m, most_m / limits::free_way_steps);
  for (float far_m = step_m; far_m < most_m + step_m; far_m += step_m)
    for (const glm::vec3& along : directions)
      if (std::ranges::none_of(points, [&](glm::vec3 p) { return is_in_rock(field, p + along * far_m); }))
        return along;
  return std::nullopt;
}

}  // namespace scree
