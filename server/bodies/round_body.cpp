#include "server/bodies/round_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

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

/// A cylinder's corners come in pairs, one at each end.
Roundness cylinder_of(const std::vector<glm::vec3>& corners_m) {
  constexpr size_t corners_min = 32;
  if (corners_m.size() < corners_min || corners_m.size() % 2 != 0) return {};
  const glm::vec3 half_axis_m = 0.5F * (corners_m[1] - corners_m[0]);
  const auto side_of = [&](size_t i) { return 0.5F * (corners_m[i] + corners_m[i + 1]); };
  const float radius_m = std::sqrt(glm::dot(side_of(0), side_of(0)));
  const auto is_small = [&](float off_m) { return std::abs(off_m) <= 1e-3F * radius_m; };
  for (size_t i = 0; i < corners_m.size(); i += 2) {
    const glm::vec3 side = side_of(i), off = 0.5F * (corners_m[i + 1] - corners_m[i]) - half_axis_m;
    if (!is_small(std::sqrt(glm::dot(side, side)) - radius_m) || !is_small(std::sqrt(glm::dot(off, off))))
      return {};
  }
  return {radius_m, limits::cylinder_sag * radius_m, half_axis_m, false};
}

/// Where a roller touches the ground of one of its points' contacts; nothing where it does not by its side.
std::optional<glm::vec3> touching_place(const Roundness& roller, glm::vec3 half_axis_m,
                                        const TerrainContact& contact) {
  const float half2 = glm::dot(half_axis_m, half_axis_m);
  const float along = std::clamp(glm::dot(contact.offset_m, half_axis_m) / half2, -1.0F, 1.0F);
  glm::vec3 down = -contact.normal;
  if (!roller.ends_round) {
    down -= half_axis_m * (glm::dot(down, half_axis_m) / half2);
    const float length = std::sqrt(glm::dot(down, down));
    if (length < limits::round_cover_min) return std::nullopt;
    down /= length;
  }
  const glm::vec3 middle = along * half_axis_m;
  if (glm::dot(contact.offset_m - middle, down) < limits::round_cover_min * roller.radius_m)
    return std::nullopt;
  return middle + roller.radius_m * down;
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

Roundness roller_of(const BodyShape& shape) {
  if (shape.nature.is_piece() || shape.parts_m.size() != 1) return {};
  const std::vector<glm::vec3>& points_m = shape.parts_m.front();
  if (points_m.size() != 2) return cylinder_of(points_m);
  if (shape.part_radii_m.size() != 1) return {};
  const float radius_m = shape.part_radii_m.front();
  const glm::vec3 half_axis_m = 0.5F * (points_m[1] - points_m[0]);
  if (glm::dot(half_axis_m, half_axis_m) < 1e-4F * radius_m * radius_m) return {};
  return {radius_m, limits::capsule_sag * radius_m, half_axis_m, true};
}

void touch_as_roller(const Roundness& roller, glm::vec3 half_axis_m, int points,
                     std::vector<TerrainContact>& contacts) {
  constexpr int slots = 16;  // along the axis: a place keeps its number while the roller turns
  std::vector<TerrainContact> touching;
  for (const TerrainContact& contact : contacts) {
    const std::optional<glm::vec3> place = touching_place(roller, half_axis_m, contact);
    if (!place) {
      touching.push_back(contact);
      continue;
    }
    TerrainContact moved = contact;
    moved.offset_m = *place;
    moved.distance_m += glm::dot(*place - contact.offset_m, contact.normal);
    const auto same = std::ranges::find_if(touching, [&](const TerrainContact& other) {
      const glm::vec3 apart_m = other.offset_m - moved.offset_m;
      return other.point >= points && glm::dot(apart_m, apart_m) < 0.04F * roller.radius_m * roller.radius_m;
    });
    if (same != touching.end()) {
      moved.point = same->point;
      if (moved.distance_m < same->distance_m) *same = moved;
      continue;
    }
    const float along = glm::dot(moved.offset_m, half_axis_m) / glm::dot(half_axis_m, half_axis_m);
    moved.point = points + static_cast<int>(std::clamp(0.5F * (along + 1.0F), 0.0F, 1.0F) * (slots - 1));
    const auto is_taken = [&](const TerrainContact& other) { return other.point == moved.point; };
    while (std::ranges::any_of(touching, is_taken)) moved.point += slots;
    touching.push_back(moved);
  }
  contacts = std::move(touching);
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
