#include "client/viewer/figures/person_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace scree {
namespace {

/// Hues by lightnesses: more than there are persons in sight.
constexpr int hues = 120;
constexpr std::array lightness{0.76F, 0.62F, 0.88F};
constexpr int colours = hues * static_cast<int>(lightness.size());
constexpr float chroma = 0.13F;

/// In OKLab (Ottosson 2020), where distances are as one sees them.
glm::vec3 lab_of(int place) {
  const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(place % hues) / hues;
  const float light = lightness.at(static_cast<size_t>(place / hues));
  // A hue tells more than a lightness, which the sun changes.
  return {0.5F * light, chroma * std::cos(angle), chroma * std::sin(angle)};
}

LineColour colour_of_place(int place) {
  const glm::vec3 lab = lab_of(place);
  const float light = 2.0F * lab.x;
  const float l = light + 0.3963377774F * lab.y + 0.2158037573F * lab.z;
  const float m = light - 0.1055613458F * lab.y - 0.0638541728F * lab.z;
  const float s = light - 0.0894841775F * lab.y - 1.2914855480F * lab.z;
  const glm::vec3 cubes(l * l * l, m * m * m, s * s * s);
  const auto byte = [](float linear) {
    return static_cast<uint8_t>(255.0F * std::pow(std::clamp(linear, 0.0F, 1.0F), 1.0F / 2.2F) + 0.5F);
  };
  return {byte(glm::dot(cubes, glm::vec3(4.0767416621F, -3.3077115913F, 0.2309699292F))),
          byte(glm::dot(cubes, glm::vec3(-1.2684380046F, 2.6097574011F, -0.3413193965F))),
          byte(glm::dot(cubes, glm::vec3(-0.0041960863F, -0.7034186147F, 1.7076147010F))), 255};
}

/// Where a session would like to be: neighbours in number are far apart.
int wish_of(uint64_t session) {
  return static_cast<int>(session * 47U % hues);
}

}  // namespace

void PersonColours::follow(std::span<const uint64_t> sessions) {
  std::erase_if(
      places_, [&](const auto& known) { return std::ranges::find(sessions, known.first) == sessions.end(); });
  for (const uint64_t session : sessions) {
    if (places_.contains(session)) continue;
    int best = wish_of(session);
    float farthest = -1.0F;
    for (int i = 0; i < colours; ++i) {
      const int place = (wish_of(session) + i) % colours;
      float near = 1.0F;
      for (const auto& [other, taken] : places_)
        near = std::min(near, glm::distance(lab_of(place), lab_of(taken)));
      // By a hair's breadth, the wish counts.
      if (near <= farthest + 1e-4F) continue;
      farthest = near;
      best = place;
    }
    places_.emplace(session, best);
  }
}

LineColour PersonColours::of(uint64_t session) const {
  const auto known = places_.find(session);
  return known == places_.end() ? LineColour{} : colour_of_place(known->second);
}

}  // namespace scree
