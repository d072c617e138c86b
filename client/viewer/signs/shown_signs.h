// What a game's signs show at a moment, from a place: words with the time that is left, and where markers
// lie in the picture. No drawing, no state.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "client/render/scene/camera.h"
#include "shared/game/sign.h"

namespace scree {

/// When the signs are looked at: Sign::until is a tick of the same count.
struct SignMoment {
  double tick = 0.0;
  double tick_rate_hz = 60.0;
};

/// Within the picture, or at its edge.
struct MarkerPlace {
  /// Parts of the picture's width and height, from its upper left.
  glm::vec2 at{0.5F};
  float metres = 0.0F;
  float opacity = 1.0F;
  /// Where the place is, from the middle of the picture, to the right and down, of length 1; nothing: it is
  /// in the picture.
  std::optional<glm::vec2> way{};
};

struct ShownSign {
  Sign sign;
  std::string words;  ///< of people: the text, with the time that is left
  std::optional<MarkerPlace> marker{};
};

/// Lines and bars by name, at most limits::sign_rows_max, then markers, the farthest first, at most
/// limits::sign_markers_max. What has ended is left out. `aspect`: width by height.
std::vector<ShownSign> shown_signs(const std::vector<Sign>& signs, const SignMoment& moment,
                                   const Camera& camera, float aspect);

/// "1:05": whole seconds, rounded up. Nothing where the sign does not count.
std::string time_left(const Sign& sign, const SignMoment& moment);

/// Nothing beside the picture beyond limits::sign_arrow_max_m.
std::optional<MarkerPlace> place_of_marker(glm::vec3 place_m, const Camera& camera, float aspect);

}  // namespace scree
