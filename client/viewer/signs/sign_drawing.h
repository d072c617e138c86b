// How signs are drawn: rectangles, triangles and words, in the order in which they lie over each other. The
// window draws them by Dear ImGui, pictures by paint(). Lines and bars lie in the middle of the picture's
// top, markers at their places. Pixels, from the picture's upper left.
#pragma once

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <variant>
#include <vector>

#include "client/viewer/signs/shown_signs.h"

namespace scree {

/// Red, green, blue, opacity.
using SignColour = std::array<uint8_t, 4>;

struct SignBox {
  glm::vec2 from{0.0F};
  glm::vec2 to{0.0F};
  SignColour colour{};
};
struct SignTriangle {
  std::array<glm::vec2, 3> corners{};
  SignColour colour{};
};
struct SignWords {
  glm::vec2 at{0.0F};  ///< upper left
  std::string words;
  SignColour colour{};
};
using SignPart = std::variant<SignBox, SignTriangle, SignWords>;

/// The letters that words are written with.
struct LetterSizes {
  std::function<float(const std::string&)> width;
  float height = 13.0F;
};

/// What lies over the picture where signs are drawn.
struct TakenRoom {
  glm::vec2 from{0.0F};
  glm::vec2 to{0.0F};
};

/// Nothing where no sign is shown. The words of markers, and markers at the picture's edge, keep clear of the
/// rows and of `taken`; words that have no room are left out.
std::vector<SignPart> draw_signs(const std::vector<ShownSign>& shown, glm::vec2 size,
                                 const LetterSizes& letters, std::vector<TakenRoom> taken = {});

}  // namespace scree
