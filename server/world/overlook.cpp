#include "server/world/overlook.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace scree {

namespace {

/// Heights are read on a square grid around the ground's middle, so many steps either way. Eyes are up to
/// `eye_steps` from the middle, so that the grid has something before each.
constexpr int half_steps = 16;
constexpr int side_steps = 2 * half_steps + 1;
constexpr int eye_steps = 10;
constexpr int steps_between_eyes = 2;
/// The step on a ground without an end, metres. On another ground, `end_steps` lead from its middle to its
/// end.
constexpr float endless_step_m = 3.0F;
constexpr float end_steps = 12.0F;
constexpr float step_min_m = 1.5F;
constexpr float step_max_m = 6.0F;

/// Height of the eye above the ground, and above higher ground beside it, metres.
constexpr float above_ground_m = 4.5F;
constexpr float above_near_m = 2.5F;

constexpr int directions = 36;
/// Directions either side of the middle of a picture.
constexpr int half_picture = 3;
constexpr float in_picture = 2.0F * half_picture + 1.0F;
constexpr float degrees_per_direction = 360.0F / directions;

/// The ground in one direction, as the eye sees it. Each number is a tangent.
struct Sight {
  float near = 0.0F;      ///< of ground closer than close_m, which hides the view
  float relief = 0.0F;    ///< of steep ground in the middle distance
  float skyline = -1.0F;  ///< the horizon's, over the level
  float away_m = 0.0F;    ///< of the ground that makes the skyline
};
/// Distances in metres where the grid's step is endless_step_m. The features of a larger ground are larger,
/// and less steep.
constexpr float close_m = 16.0F;
constexpr float relief_from_m = 14.0F;
constexpr float relief_best_m = 26.0F;
constexpr float relief_to_m = 50.0F;
constexpr float steep = 0.6F;  ///< rise in a metre
constexpr float relief_enough = 0.3F;
constexpr float edges_enough = 0.5F;
constexpr float skyline_high = 0.25F;

glm::vec2 direction_of(int index) {
  const float yaw = static_cast<float>(index) * degrees_per_direction * 0.01745329F;
  return {-std::sin(yaw), -std::cos(yaw)};
}

class HeightGrid {
 public:
  explicit HeightGrid(const TerrainSource& source) : step_m_(step_of(source)) {
    for (int z = -half_steps; z <= half_steps; ++z)
      for (int x = -half_steps; x <= half_steps; ++x)
        heights_m_.push_back(
            ground_height_m(source, static_cast<float>(x) * step_m_, static_cast<float>(z) * step_m_));
  }

  float step_m() const { return step_m_; }
  float scale() const { return step_m_ / endless_step_m; }
  /// The value at a point of the grid, or at the nearest.
  float at(int x, int z) const {
    return heights_m_[static_cast<size_t>(index_of(z) * side_steps + index_of(x))];
  }
  /// Between points, metres; nothing is beyond the grid.
  std::optional<float> at_m(glm::vec2 place_m) const {
    const float x = place_m.x / step_m_, z = place_m.y / step_m_;
    if (std::max(std::abs(x), std::abs(z)) > static_cast<float>(half_steps)) return std::nullopt;
    const int x0 = static_cast<int>(std::floor(x)), z0 = static_cast<int>(std::floor(z));
    const float u = x - static_cast<float>(x0), v = z - static_cast<float>(z0);
    return (1.0F - v) * ((1.0F - u) * at(x0, z0) + u * at(x0 + 1, z0)) +
           v * ((1.0F - u) * at(x0, z0 + 1) + u * at(x0 + 1, z0 + 1));
  }

 private:
  static float step_of(const TerrainSource& source) {
    const auto extent = extent_of(source);
    if (!extent) return endless_step_m;
    return std::clamp(std::min(extent->half_width_m, extent->half_depth_m) / end_steps, step_min_m,
                      step_max_m);
  }
  static int index_of(int step) { return std::clamp(step + half_steps, 0, side_steps - 1); }

  float step_m_;
  std::vector<float> heights_m_;  ///< x fastest
};

float weight_at(float away_m) {
  return std::clamp((away_m - relief_from_m) / (relief_best_m - relief_from_m), 0.0F, 1.0F);
}

/// Outwards from the eye, as far as the grid goes.
Sight sight_along(const HeightGrid& grid, glm::vec3 eye_m, glm::vec2 direction) {
  Sight sight;
  const float step_m = 0.5F * grid.step_m(), scale = grid.scale();
  float before_m = eye_m.y - above_ground_m;
  for (float away_m = step_m;; away_m += step_m) {
    const auto ground_m = grid.at_m(glm::vec2(eye_m.x, eye_m.z) + away_m * direction);
    if (!ground_m) return sight;
    const float rise = (*ground_m - eye_m.y) / away_m, gain = rise - sight.skyline;
    if (gain > 0.0F) {
      sight.skyline = rise;
      sight.away_m = away_m;
      if (away_m < close_m * scale) sight.near = std::max(0.0F, rise);
      const bool faces = *ground_m - before_m > steep * step_m / std::max(1.0F, scale);
      if (faces && away_m <= relief_to_m * scale) sight.relief += gain * weight_at(away_m / scale);
    }
    before_m = *ground_m;
  }
}

struct Picture {
  float worth = 0.0F;
  float skyline = 0.0F;  ///< in the middle of it
};

/// How much nearer or farther a skyline is than the one beside it.
float edge_between(const Sight& a, const Sight& b, float scale) {
  const float near_m = std::min(a.away_m, b.away_m), far_m = std::max(a.away_m, b.away_m);
  return std::abs(a.skyline - b.skyline) * (1.0F - near_m / far_m) * weight_at(near_m / scale);
}

/// Relief is worth most, then things that stand out before their background. Close ground that hides the
/// view, and ground that hides the sky, are worth less than nothing.
Picture picture_of(const std::array<Sight, directions>& sights, int middle, float scale) {
  const auto sight_at = [&](int i) -> const Sight& {
    return sights[static_cast<size_t>((i + directions) % directions)];
  };
  Picture picture;
  float relief = 0.0F, edges = 0.0F, hidden = 0.0F;
  for (int i = middle - half_picture; i <= middle + half_picture; ++i) {
    const Sight& sight = sight_at(i);
    relief += std::min(sight.relief, relief_enough);
    edges += edge_between(sight, sight_at(i + 1), scale);
    hidden += std::max(0.0F, sight.skyline - skyline_high) + sight.near;
    picture.skyline += sight.skyline / in_picture;
  }
  picture.worth =
      2.0F * relief / in_picture + 2.0F * std::min(edges, edges_enough) - 3.0F * hidden / in_picture;
  return picture;
}

/// An eye so far above the ground that nothing near hides the view. Nothing where that is high over the
/// ground.
std::optional<glm::vec3> eye_at(const HeightGrid& grid, int x, int z) {
  const float ground_m = grid.at(x, z);
  float eye_m = ground_m + above_ground_m;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dx = -1; dx <= 1; ++dx) eye_m = std::max(eye_m, grid.at(x + dx, z + dz) + above_near_m);
  if (eye_m > ground_m + 2.0F * above_ground_m) return std::nullopt;
  return glm::vec3(static_cast<float>(x) * grid.step_m(), eye_m, static_cast<float>(z) * grid.step_m());
}

/// Adds a little for a picture near the ground's middle that shows it.
float worth_of_place(const HeightGrid& grid, glm::vec3 eye_m, glm::vec2 direction) {
  const glm::vec2 to_middle = -glm::vec2(eye_m.x, eye_m.z);
  const float away_steps = glm::length(to_middle) / grid.step_m();
  if (away_steps < 0.5F) return 0.0F;
  const float ahead = glm::dot(direction, glm::normalize(to_middle));
  const float apt = std::max(0.0F, 1.0F - 0.25F * std::abs(away_steps - 5.0F));
  return 0.12F * std::max(0.0F, ahead) * apt - 0.01F * away_steps;
}

/// Degrees. The skyline is above the middle of the picture, and below its upper edge.
float pitch_for(float skyline) {
  return std::clamp(-9.0F + 30.0F * skyline, -25.0F, 2.0F);
}

}  // namespace

Spawn overlook_of(const TerrainSource& source) {
  const HeightGrid grid(source);
  Spawn best{
      .eye_m = {0.0F, grid.at(0, 0) + above_ground_m, 0.0F}, .yaw_degrees = 0.0F, .pitch_degrees = -10.0F};
  float most = -1.0e9F;
  for (int z = -eye_steps; z <= eye_steps; z += steps_between_eyes)
    for (int x = -eye_steps; x <= eye_steps; x += steps_between_eyes) {
      const auto eye_m = eye_at(grid, x, z);
      if (!eye_m) continue;
      std::array<Sight, directions> sights;
      for (int i = 0; i < directions; ++i)
        sights[static_cast<size_t>(i)] = sight_along(grid, *eye_m, direction_of(i));
      for (int i = 0; i < directions; ++i) {
        const Picture picture = picture_of(sights, i, grid.scale());
        const float worth = picture.worth + worth_of_place(grid, *eye_m, direction_of(i));
        if (worth <= most) continue;
        most = worth;
        best = {*eye_m, static_cast<float>(i) * degrees_per_direction, pitch_for(picture.skyline)};
      }
    }
  return rounded(best);
}

}  // namespace scree
