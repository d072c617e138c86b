// Where the panels over the picture stand, so that no two of them overlap at any size of the window. Pixels,
// from the upper left. No window, no Dear ImGui.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

namespace scree {

/// A place for one panel. The strips stand in the middle, above and below; lowest the tool, or a replay's
/// timeline. The others stand in two columns between them.
enum class PanelPlace : uint8_t { top, bottom, upper_left, lower_left, upper_right, lower_right, lowest };

inline constexpr size_t panel_places = 7;

constexpr size_t index_of(PanelPlace place) {
  return static_cast<size_t>(place);
}

struct Rectangle {
  glm::vec2 at{0.0F};
  glm::vec2 size{0.0F};

  bool operator==(const Rectangle&) const = default;
};

/// By PanelPlace.
using PanelSizes = std::array<glm::vec2, panel_places>;
using PanelRectangles = std::array<Rectangle, panel_places>;

inline constexpr float panel_margin = 8.0F;  ///< around each panel

/// Part of the window's height, without margins, that a strip takes at most.
inline constexpr float strip_share_max = 0.25F;

/// A rectangle for each panel, of the size that it wants as far as there is room. Strips come first, and the
/// columns share the rest. A column's two panels share its height: one that wants less than half leaves the
/// rest to the other. A panel that wants nothing gets nothing. Where a panel gets less than it wants, it
/// scrolls.
PanelRectangles lay_out(glm::vec2 screen, const PanelSizes& wanted);

/// The width of both columns as wanted, with the margins.
float columns_width(const PanelSizes& wanted);

bool intersect(const Rectangle& a, const Rectangle& b);

}  // namespace scree
