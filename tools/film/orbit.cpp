#include "tools/film/orbit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "client/render/scene/look_at.h"
#include "shared/base/check.h"

namespace scree {
namespace {

constexpr float turn = 2.0F * std::numbers::pi_v<float>;
constexpr float radians_per_degree = turn / 360.0F;

/// Slow enough to watch what happens; 8 s go a quarter of the way round.
constexpr float speed_per_s = 12.0F * radians_per_degree;

/// From the middle of an event: what is thrown out flies some metres, and more of it where the event is
/// large.
constexpr float distance_least_m = 9.0F;
constexpr float distance_per_radius = 4.0F;
constexpr float distance_most_m = 150.0F;
/// The radius of an event without a volume, such as a fill.
constexpr float radius_least_m = 1.0F;

constexpr std::array heights = {18.0F * radians_per_degree, 30.0F * radians_per_degree,
                                45.0F * radians_per_degree, 65.0F * radians_per_degree};
/// Directions from which it is tried whether the event is in sight.
constexpr size_t directions = 48;

float radius_of(const Event& event) {
  const float ball_m = std::cbrt(event.volume_m3 * 3.0F / (2.0F * turn));
  return std::max(ball_m, radius_least_m);
}

/// Unit, from the event to the camera.
glm::vec3 direction_of(float angle, float height) {
  return {std::cos(height) * std::sin(angle), std::sin(height), std::cos(height) * std::cos(angle)};
}

/// Whether no rock lies between an eye and the border of the event.
bool is_in_sight(Field& field, glm::vec3 eye_m, glm::vec3 place_m, float radius_m) {
  const float voxel_m = field.source().voxel_size_m;
  const float way_m = glm::distance(eye_m, place_m) - radius_m;
  return way_m <= 0.0F ||
         !trace(field, eye_m / voxel_m, glm::normalize(place_m - eye_m), way_m / voxel_m).has_value();
}

/// So many directions in a row of which most are open, and how many are; where there are several such arcs,
/// the one in their middle: it is the farthest from rock.
struct Arc {
  size_t first = 0;
  size_t open = 0;
};

Arc most_open(const std::array<bool, directions>& open, size_t length) {
  std::array<size_t, directions> counts{};
  for (size_t first = 0; first < directions; ++first)
    for (size_t i = 0; i < length; ++i) counts[first] += open[(first + i) % directions] ? 1 : 0;
  const size_t most = *std::ranges::max_element(counts);
  Arc best{0, most};
  size_t longest = 0;
  for (size_t first = 0; first < directions; ++first) {
    size_t run = 0;
    while (run < directions && counts[(first + run) % directions] == most) ++run;
    if (run <= longest) continue;
    longest = run;
    best.first = (first + run / 2) % directions;
  }
  return best;
}

}  // namespace

Orbit Orbit::around(const Event& event, Field& field, double seconds) {
  CHECK(event.place_m.has_value());
  Orbit orbit;
  const float radius_m = radius_of(event);
  orbit.place_m_ = *event.place_m;
  orbit.distance_m_ = std::min(distance_least_m + distance_per_radius * radius_m, distance_most_m);
  constexpr float step = turn / static_cast<float>(directions);
  const float way = std::min(static_cast<float>(seconds) * speed_per_s, turn);
  const auto length = std::min(static_cast<size_t>(way / step) + 1, directions);
  size_t most = 0;
  for (const float height : heights) {
    std::array<bool, directions> open{};
    for (size_t i = 0; i < directions; ++i) {
      const glm::vec3 away = direction_of(static_cast<float>(i) * step, height);
      open[i] = is_in_sight(field, orbit.place_m_ + away * orbit.distance_m_, orbit.place_m_, radius_m);
    }
    const Arc arc = most_open(open, length);
    if (arc.open <= most && height != heights.front()) continue;
    most = arc.open;
    orbit.height_ = height;
    orbit.start_ = static_cast<float>(arc.first) * step;
  }
  return orbit;
}

Camera Orbit::at(double time_s) const {
  const float angle = start_ + static_cast<float>(time_s) * speed_per_s;
  return look_at(place_m_ + direction_of(angle, height_) * distance_m_, place_m_);
}

}  // namespace scree
