#include "client/viewer/signs/sign_drawing.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace scree {
namespace {

/// Behind words, so that they are read over any terrain.
constexpr SignColour ground{12, 10, 8, 150};
constexpr SignColour empty_bar{255, 255, 255, 50};
/// Widths of a bar, in heights of the letters; of the picture's width at most.
constexpr float bar_width = 16.0F, bar_height = 0.35F, row_width_share = 0.9F;
constexpr float diamond_half = 0.45F, arrow_length = 0.8F;

SignColour colour_of(const Sign& sign, float opacity = 1.0F) {
  return {sign.colour[0], sign.colour[1], sign.colour[2],
          static_cast<uint8_t>(std::lround(255.0F * std::clamp(opacity, 0.0F, 1.0F)))};
}

SignColour fainter(SignColour colour, float opacity) {
  colour[3] = static_cast<uint8_t>(std::lround(static_cast<float>(colour[3]) * opacity));
  return colour;
}

class Drawing {
 public:
  Drawing(glm::vec2 size, const LetterSizes& letters)
      : size_(size), letters_(letters), gap_(0.3F * letters.height) {}

  void row(const ShownSign& shown) {
    const bool is_bar = shown.sign.kind == SignKind::bar;
    const float most = row_width_share * size_.x - 2.0F * gap_;
    const float words = shown.words.empty() ? 0.0F : letters_.width(shown.words);
    const float inner = std::min(std::max(words, is_bar ? bar_width * letters_.height : 0.0F), most);
    const float bar = is_bar ? bar_height * letters_.height : 0.0F;
    const float text = shown.words.empty() ? 0.0F : letters_.height;
    const float between = bar > 0.0F && text > 0.0F ? gap_ : 0.0F;
    if (text + bar == 0.0F) return;
    const glm::vec2 from(std::round(0.5F * (size_.x - inner) - gap_), std::round(top_));
    const glm::vec2 to(from.x + inner + 2.0F * gap_, from.y + text + between + bar + 2.0F * gap_);
    parts_.push_back(SignBox{from, to, ground});
    if (text > 0.0F)
      write({std::max(0.5F * (from.x + to.x - words), from.x + gap_), from.y + gap_}, shown.words,
            colour_of(shown.sign));
    if (is_bar) {
      const glm::vec2 left(from.x + gap_, to.y - gap_ - bar), right(to.x - gap_, to.y - gap_);
      const float end = glm::mix(left.x, right.x, std::clamp(shown.sign.share, 0.0F, 1.0F));
      parts_.push_back(SignBox{left, right, empty_bar});
      if (end > left.x) parts_.push_back(SignBox{left, {end, right.y}, colour_of(shown.sign)});
    }
    top_ = to.y + 0.4F * gap_;
  }

  void marker(const ShownSign& shown) {
    const MarkerPlace& place = *shown.marker;
    const SignColour colour = colour_of(shown.sign, place.opacity);
    const glm::vec2 at = glm::clamp(place.at, 0.0F, 1.0F) * size_;
    const float half = diamond_half * letters_.height;
    diamond(at, half + 1.5F, fainter({0, 0, 0, 170}, place.opacity));
    diamond(at, half, colour);
    if (place.way) arrow(at, *place.way, half, colour);
    if (shown.words.empty()) return;
    // Above the diamond, and beneath it where there is no room.
    const float width = letters_.width(shown.words);
    const float above = at.y - half - gap_ - letters_.height;
    const glm::vec2 lowest(gap_, gap_);
    const glm::vec2 highest(std::max(size_.x - width - gap_, gap_),
                            std::max(size_.y - letters_.height - gap_, gap_));
    const glm::vec2 corner = glm::clamp(
        glm::vec2(at.x - 0.5F * width, above >= gap_ ? above : at.y + half + gap_), lowest, highest);
    const glm::vec2 margin(0.5F * gap_, 0.2F * gap_);
    parts_.push_back(SignBox{corner - margin, corner + glm::vec2(width, letters_.height) + margin,
                             fainter(ground, place.opacity)});
    write(corner, shown.words, colour);
  }

  std::vector<SignPart> take() { return std::move(parts_); }

 private:
  void write(glm::vec2 at, const std::string& words, SignColour colour) {
    parts_.push_back(SignWords{glm::round(at), words, colour});
  }
  void diamond(glm::vec2 at, float half, SignColour colour) {
    const glm::vec2 across(half, 0.0F), along(0.0F, half);
    parts_.push_back(SignTriangle{{at - across, at - along, at + across}, colour});
    parts_.push_back(SignTriangle{{at + across, at + along, at - across}, colour});
  }
  void arrow(glm::vec2 at, glm::vec2 way, float half, SignColour colour) {
    const glm::vec2 beside(-way.y, way.x);
    const glm::vec2 foot = at + way * (half + 3.0F);
    const float wide = 0.7F * half;
    parts_.push_back(SignTriangle{
        {foot - beside * wide, foot + beside * wide, foot + way * (arrow_length * letters_.height)}, colour});
  }

  glm::vec2 size_;
  const LetterSizes& letters_;
  float gap_;
  float top_ = 0.5F * letters_.height;
  std::vector<SignPart> parts_;
};

}  // namespace

std::vector<SignPart> draw_signs(const std::vector<ShownSign>& shown, glm::vec2 size,
                                 const LetterSizes& letters) {
  Drawing drawing(size, letters);
  // Markers come last and lie beneath the rows.
  for (const ShownSign& one : shown)
    if (one.marker) drawing.marker(one);
  for (const ShownSign& one : shown)
    if (!one.marker) drawing.row(one);
  return drawing.take();
}

}  // namespace scree
