#include "client/viewer/signs/sign_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>

namespace scree {
namespace {

/// Behind words, so that they are read over any terrain.
constexpr SignColour ground{12, 10, 8, 150};
constexpr SignColour empty_bar{255, 255, 255, 50};
/// Widths of a bar, in heights of the letters; of the picture's width at most.
constexpr float bar_width = 16.0F, bar_height = 0.35F, row_width_share = 0.9F;
constexpr float diamond_half = 0.45F, arrow_length = 0.8F;
constexpr float arrow_gap = 3.0F;  ///< pixels between the diamond and its arrow

SignColour colour_of(const Sign& sign, float opacity = 1.0F) {
  return {sign.colour[0], sign.colour[1], sign.colour[2],
          static_cast<uint8_t>(std::lround(255.0F * std::clamp(opacity, 0.0F, 1.0F)))};
}

bool meet(const TakenRoom& a, const TakenRoom& b) {
  return a.from.x < b.to.x && b.from.x < a.to.x && a.from.y < b.to.y && b.from.y < a.to.y;
}

SignColour fainter(SignColour colour, float opacity) {
  colour[3] = static_cast<uint8_t>(std::lround(static_cast<float>(colour[3]) * opacity));
  return colour;
}

class Drawing {
 public:
  Drawing(glm::vec2 size, const LetterSizes& letters, std::vector<TakenRoom>&& taken)
      : size_(size), letters_(letters), gap_(0.3F * letters.height), taken_(std::move(taken)) {}

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
    taken_.push_back({from, to});
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
    const float half = diamond_half * letters_.height;
    glm::vec2 at = glm::clamp(place.at, 0.0F, 1.0F) * size_;
    if (place.way) at = beside_taken(at, half + arrow_gap + arrow_length * letters_.height);
    diamond(at, half + 1.5F, fainter({0, 0, 0, 170}, place.opacity));
    diamond(at, half, colour);
    if (place.way) arrow(at, *place.way, half, colour);
    if (shown.words.empty()) return;
    const glm::vec2 margin(0.5F * gap_, 0.2F * gap_), words(letters_.width(shown.words), letters_.height);
    const std::optional<glm::vec2> place_of = place_of_words(at, half, words);
    if (!place_of) return;
    const glm::vec2 corner = *place_of;
    parts_.push_back(SignBox{corner - margin, corner + words + margin, fainter(ground, place.opacity)});
    write(corner, shown.words, colour);
  }

  std::vector<SignPart> take() { return std::exchange(parts_, {}); }

 private:
  bool is_taken(const TakenRoom& room) const {
    return std::ranges::any_of(taken_, [&](const TakenRoom& one) { return meet(room, one); });
  }
  /// Above the diamond; beneath it, or to its right or left, where there is no room. Nothing: there is none
  /// anywhere, and the words would be covered.
  std::optional<glm::vec2> place_of_words(glm::vec2 at, float half, glm::vec2 words) const {
    const glm::vec2 lowest(gap_);
    const glm::vec2 highest = glm::max(size_ - words - gap_, lowest);
    const float off = half + gap_;
    const glm::vec2 above(at.x - 0.5F * words.x, at.y - off - words.y);
    const std::array<glm::vec2, 4> places{{above,
                                           {above.x, at.y + off},
                                           {at.x + off, at.y - 0.5F * words.y},
                                           {at.x - off - words.x, at.y - 0.5F * words.y}}};
    for (const glm::vec2& place : places) {
      const glm::vec2 corner(std::clamp(place.x, lowest.x, highest.x), place.y);
      const bool moved_over_it = &place > &places[1] && corner.x != place.x;
      const bool is_within = corner.y >= lowest.y && corner.y <= highest.y;
      if (is_within && !moved_over_it && !is_taken({corner, corner + words})) return corner;
    }
    return std::nullopt;
  }
  /// Towards the middle of the picture's height until nothing lies over it.
  glm::vec2 beside_taken(glm::vec2 at, float room) const {
    const float reach = room + 1.0F;
    const bool is_high = at.y < 0.5F * size_.y;
    glm::vec2 moved = at;
    for (size_t i = 0; i < taken_.size(); ++i) {
      const auto over = std::ranges::find_if(taken_, [&](const TakenRoom& one) {
        return meet({moved - reach, moved + reach}, one);
      });
      if (over == taken_.end()) return moved;
      moved.y = is_high ? over->to.y + reach : over->from.y - reach;
      if (is_high != (moved.y < 0.5F * size_.y)) break;
    }
    return at;
  }
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
    const glm::vec2 foot = at + way * (half + arrow_gap);
    const float wide = 0.7F * half;
    parts_.push_back(SignTriangle{
        {foot - beside * wide, foot + beside * wide, foot + way * (arrow_length * letters_.height)}, colour});
  }

  glm::vec2 size_;
  const LetterSizes& letters_;
  float gap_;
  std::vector<TakenRoom> taken_;
  float top_ = 0.5F * letters_.height;
  std::vector<SignPart> parts_;
};

}  // namespace

std::vector<SignPart> draw_signs(const std::vector<ShownSign>& shown, glm::vec2 size,
                                 const LetterSizes& letters, std::vector<TakenRoom> taken) {
  Drawing drawing(size, letters, std::move(taken));
  for (const ShownSign& one : shown)
    if (!one.marker) drawing.row(one);
  const std::vector<SignPart> rows = drawing.take();
  for (const ShownSign& one : shown)
    if (one.marker) drawing.marker(one);
  // Markers lie beneath the rows.
  std::vector<SignPart> parts = drawing.take();
  parts.insert(parts.end(), rows.begin(), rows.end());
  return parts;
}

}  // namespace scree
