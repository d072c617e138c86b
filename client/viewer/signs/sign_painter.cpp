#include "client/viewer/signs/sign_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <imgui/imgui.h>

#include "shared/base/overloaded.h"

namespace scree {
namespace {

/// Height of the letters: that part of the picture's, but so many pixels at least, as the window's.
constexpr int letters_in_height = 42, letters_min_px = 13;

void blend(Image& image, int x, int y, SignColour colour, float cover) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  const float part = cover * static_cast<float>(colour[3]) / 255.0F;
  uint8_t* const pixel = image.rgb.data() + 3 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) +
                                                 static_cast<size_t>(x));
  for (size_t i = 0; i < 3; ++i)
    pixel[i] = static_cast<uint8_t>(
        std::lround(glm::mix(static_cast<float>(pixel[i]), static_cast<float>(colour[i]), part)));
}

int whole(float place) {
  return static_cast<int>(std::lround(place));
}

void paint_box(Image& image, const SignBox& box) {
  for (int y = std::max(whole(box.from.y), 0); y < std::min(whole(box.to.y), image.height); ++y)
    for (int x = std::max(whole(box.from.x), 0); x < std::min(whole(box.to.x), image.width); ++x)
      blend(image, x, y, box.colour, 1.0F);
}

float side_of(glm::vec2 from, glm::vec2 to, glm::vec2 at) {
  return (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x);
}

bool is_within(const std::array<glm::vec2, 3>& corners, glm::vec2 at) {
  const float a = side_of(corners[0], corners[1], at), b = side_of(corners[1], corners[2], at),
              c = side_of(corners[2], corners[0], at);
  return (a >= 0.0F && b >= 0.0F && c >= 0.0F) || (a <= 0.0F && b <= 0.0F && c <= 0.0F);
}

/// A pixel is covered by as many of its 16 points as lie within.
void paint_triangle(Image& image, const SignTriangle& triangle) {
  const auto& corners = triangle.corners;
  const glm::vec2 lo = glm::min(corners[0], glm::min(corners[1], corners[2]));
  const glm::vec2 hi = glm::max(corners[0], glm::max(corners[1], corners[2]));
  for (int y = static_cast<int>(std::floor(lo.y)); y <= static_cast<int>(hi.y); ++y)
    for (int x = static_cast<int>(std::floor(lo.x)); x <= static_cast<int>(hi.x); ++x) {
      int points = 0;
      for (int i = 0; i < 16; ++i)
        points += is_within(corners, glm::vec2(x, y) + (glm::vec2(i % 4, i / 4) + 0.5F) * 0.25F) ? 1 : 0;
      blend(image, x, y, triangle.colour, static_cast<float>(points) / 16.0F);
    }
}

/// The character at `at`, which moves behind it. Texts of signs are UTF-8 (validate()); what is beyond the
/// letters' 16 bits has none.
ImWchar next_character(const char*& at, const char* end) {
  const auto first = static_cast<unsigned char>(*at++);
  uint32_t code = first < 0x80U ? first : first & (first >= 0xE0U ? 0x0FU : 0x1FU);
  for (; at < end && (static_cast<unsigned char>(*at) & 0xC0U) == 0x80U; ++at)
    code = code << 6U | (static_cast<unsigned char>(*at) & 0x3FU);
  return first >= 0xF0U ? ImWchar{0xFFFD} : static_cast<ImWchar>(code);
}

}  // namespace

/// Dear ImGui's own letters as a picture of one byte a pixel; no context, and no OpenGL.
struct SignPainter::Letters {
  explicit Letters(int height) : height_px(height) {
    ImFontConfig config;
    config.SizePixels = static_cast<float>(height);
    config.OversampleH = config.OversampleV = 1;
    config.PixelSnapH = true;
    font = atlas.AddFontDefault(&config);
    unsigned char* made = nullptr;
    atlas.GetTexDataAsAlpha8(&made, &width, nullptr);
    alpha = made;
  }

  float width_of(const std::string& words) const {
    return font->CalcTextSizeA(static_cast<float>(height_px), 1e6F, 0.0F, words.c_str()).x;
  }

  void paint(Image& image, const SignWords& text) const {
    float x = text.at.x;
    for (const char *at = text.words.data(), *end = at + text.words.size(); at < end;) {
      const ImFontGlyph* const glyph = font->FindGlyph(next_character(at, end));
      if (glyph == nullptr) continue;
      paint(image, *glyph, {x, text.at.y}, text.colour);
      x += glyph->AdvanceX;
    }
  }

  int height_px;
  ImFontAtlas atlas;
  ImFont* font = nullptr;
  const unsigned char* alpha = nullptr;
  int width = 0;

 private:
  void paint(Image& image, const ImFontGlyph& glyph, glm::vec2 at, SignColour colour) const {
    const int left = whole(at.x + glyph.X0), top = whole(at.y + glyph.Y0);
    const auto high = static_cast<float>(atlas.TexHeight), wide = static_cast<float>(width);
    const int u = whole(glyph.U0 * wide), v = whole(glyph.V0 * high);
    for (int y = 0; y < whole(glyph.V1 * high) - v; ++y)
      for (int x = 0; x < whole(glyph.U1 * wide) - u; ++x)
        blend(image, left + x, top + y, colour, static_cast<float>(alpha[(v + y) * width + u + x]) / 255.0F);
  }
};

SignPainter::SignPainter() = default;
SignPainter::~SignPainter() = default;
SignPainter::SignPainter(SignPainter&&) noexcept = default;
SignPainter& SignPainter::operator=(SignPainter&&) noexcept = default;

const SignPainter::Letters& SignPainter::letters_of(int height_px) {
  if (!letters_ || letters_->height_px != height_px) letters_ = std::make_unique<Letters>(height_px);
  return *letters_;
}

void SignPainter::paint(Image& image, const std::vector<Sign>& signs, const SignMoment& moment,
                        const Camera& camera) {
  if (signs.empty() || image.width <= 0 || image.height <= 0) return;
  const glm::vec2 size(image.width, image.height);
  const auto shown = shown_signs(signs, moment, camera, size.x / size.y);
  if (shown.empty()) return;
  const Letters& letters = letters_of(std::max(letters_min_px, image.height / letters_in_height));
  const LetterSizes sizes{[&](const std::string& words) { return letters.width_of(words); },
                          static_cast<float>(letters.height_px)};
  for (const SignPart& part : draw_signs(shown, size, sizes))
    std::visit(Overloaded{[&](const SignBox& box) { paint_box(image, box); },
                          [&](const SignTriangle& triangle) { paint_triangle(image, triangle); },
                          [&](const SignWords& words) { letters.paint(image, words); }},
               part);
}

}  // namespace scree
