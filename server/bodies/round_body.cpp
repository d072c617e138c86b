#include "server/bodies/round_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/bodies/limits.h"

namespace scree {

namespace {

constexpr int grid = 3;  ///< directions are those to the places of a cube's surface of so many steps a way

/// The cosine of the widest angle from any direction to the nearest point. Points are of about that length.
float cover_of(const std::vector<glm::vec3>& points_m, float radius_m) {
  float cover = 1.0F;
  for (int x = -grid; x <= grid; ++x)
    for (int y = -grid; y <= grid; ++y)
      for (int z = -grid; z <= grid; ++z) {
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) != grid) continue;
        const glm::vec3 way(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        float most = 0.0F;
        for (const glm::vec3& p : points_m) most = std::max(most, glm::dot(p, way));
        cover = std::min(cover, most / (radius_m * std::sqrt(glm::dot(way, way))));
        if (cover < limits::round_cover_min) return cover;
      }
  return cover;
}

}  // namespace

Roundness roundness_of(const std::vector<glm::vec3>& points_m) {
  float sum_m = 0.0F, least_m = 1e30F, most_m = 0.0F;
  for (const glm::vec3& p : points_m) {
    const float length_m = std::sqrt(glm::dot(p, p));
    sum_m += length_m;
    least_m = std::min(least_m, length_m);
    most_m = std::max(most_m, length_m);
  }
  const float radius_m = sum_m / static_cast<float>(points_m.size());
  const float off_m = limits::round_off * radius_m;
  if (least_m < radius_m - off_m || most_m > radius_m + off_m) return {};
  const float cover = cover_of(points_m, radius_m);
  if (cover < limits::round_cover_min) return {};
  return {radius_m, radius_m * (1.0F - cover) + off_m};
}

// The ground about a point's contact is taken for the plane there.
void touch_as_ball(const Roundness& ball, int points, std::vector<TerrainContact>& contacts) {
  std::vector<TerrainContact> touching;
  for (const TerrainContact& contact : contacts) {
    const float below_m = -glm::dot(contact.offset_m, contact.normal);
    if (below_m < limits::round_cover_min * ball.radius_m) {
      touching.push_back(contact);
      continue;
    }
    TerrainContact moved = contact;
    moved.offset_m = -ball.radius_m * contact.normal;
    moved.distance_m += below_m - ball.radius_m;
    const auto same = std::ranges::find_if(touching, [&](const TerrainContact& other) {
      const glm::vec3 apart_m = other.offset_m - moved.offset_m;
      return other.point >= points && glm::dot(apart_m, apart_m) < 0.04F * ball.radius_m * ball.radius_m;
    });
    if (same == touching.end()) {
      moved.point = points + static_cast<int>(touching.size());
      touching.push_back(moved);
    } else if (moved.distance_m < same->distance_m) {
      moved.point = same->point;
      *same = moved;
    }
  }
  contacts = std::move(touching);
}

}  // namespace scree
