#include "client/viewer/signs/shown_signs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "client/viewer/signs/limits.h"

namespace scree {
namespace {

/// So far from the picture's edge is what belongs beside it, as a part of its height: room for a diamond with
/// its words.
constexpr float edge = 0.06F;
/// The projection ends nowhere near: markers are drawn, however far they are.
constexpr float endless_m = 1.0e5F;

float opacity_at(float metres) {
  const float far = (metres - limits::sign_near_m) / (limits::sign_far_m - limits::sign_near_m);
  return glm::mix(1.0F, limits::sign_faintest, std::clamp(far, 0.0F, 1.0F));
}

/// From the middle towards `way` to the frame that the edge leaves.
glm::vec2 at_edge(glm::vec2 way, float aspect) {
  const glm::vec2 half(0.5F * aspect - edge, 0.5F - edge);
  const float across = std::abs(way.x) > 1e-6F ? half.x / std::abs(way.x) : endless_m;
  const float along = std::abs(way.y) > 1e-6F ? half.y / std::abs(way.y) : endless_m;
  const glm::vec2 off = way * std::min(across, along);
  return {0.5F + off.x / aspect, 0.5F + off.y};
}

/// Rows by name, then markers, the farthest first.
bool lies_before(const ShownSign& a, const ShownSign& b) {
  if (a.marker.has_value() != b.marker.has_value()) return b.marker.has_value();
  if (a.marker && a.marker->metres != b.marker->metres) return a.marker->metres > b.marker->metres;
  const int order = a.sign.name.compare(b.sign.name);
  return order != 0 ? order < 0 : sign_before(a.sign, b.sign);
}

}  // namespace

std::string time_left(const Sign& sign, const SignMoment& moment) {
  if (sign.until == 0 || !sign.counts) return {};
  const double left_s = (static_cast<double>(sign.until) - moment.tick) / std::max(moment.tick_rate_hz, 1.0);
  const auto seconds = static_cast<uint64_t>(std::ceil(std::clamp(left_s, 0.0, 1e9)));
  const std::string rest = std::to_string(seconds % 60);
  return std::to_string(seconds / 60) + (rest.size() < 2 ? ":0" : ":") + rest;
}

std::optional<MarkerPlace> place_of_marker(glm::vec3 place_m, const Camera& camera, float aspect) {
  const glm::vec4 seen = camera.view() * glm::vec4(place_m, 1.0F);
  const glm::vec4 clip = camera.projection(aspect, endless_m) * seen;
  MarkerPlace place;
  place.metres = glm::distance(place_m, camera.eye_m);
  place.opacity = opacity_at(place.metres);
  if (clip.w > 0.0F && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w) {
    place.at = glm::vec2(clip.x, -clip.y) / clip.w * 0.5F + 0.5F;
    return place;
  }
  if (place.metres > limits::sign_arrow_max_m) return std::nullopt;
  const glm::vec2 way(seen.x, -seen.y);
  const float far = glm::length(way);
  // Straight behind is down, as good as any.
  place.way = far > 1e-3F ? way / far : glm::vec2(0.0F, 1.0F);
  place.at = at_edge(*place.way, aspect);
  return place;
}

std::vector<ShownSign> shown_signs(const std::vector<Sign>& signs, const SignMoment& moment,
                                   const Camera& camera, float aspect) {
  std::vector<ShownSign> all;
  for (const Sign& sign : signs) {
    if (sign.until != 0 && moment.tick >= static_cast<double>(sign.until)) continue;
    ShownSign shown{sign, sign.text};
    if (const std::string left = time_left(sign, moment); !left.empty())
      shown.words += (shown.words.empty() ? "" : " ") + left;
    if (sign.kind == SignKind::marker) shown.marker = place_of_marker(sign.place_m, camera, aspect);
    if (sign.kind != SignKind::marker || shown.marker) all.push_back(std::move(shown));
  }
  std::ranges::sort(all, lies_before);
  const auto rows = static_cast<size_t>(
      std::ranges::count_if(all, [](const ShownSign& one) { return !one.marker.has_value(); }));
  const size_t left_out = all.size() - rows - std::min(all.size() - rows, limits::sign_markers_max);
  const size_t kept = std::min(rows, limits::sign_rows_max);
  all.erase(all.begin() + static_cast<ptrdiff_t>(kept),
            all.begin() + static_cast<ptrdiff_t>(rows + left_out));
  return all;
}

}  // namespace scree
