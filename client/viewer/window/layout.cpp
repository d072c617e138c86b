#include "client/viewer/window/layout.h"

#include <algorithm>
#include <utility>

namespace scree {
namespace {

/// `room` shared by two that want so much: who wants less than half gets it all.
std::pair<float, float> share(float room, float a, float b) {
  room = std::max(room, 0.0F);
  if (a + b <= room) return {a, b};
  const float half = room * 0.5F;
  if (a <= half) return {a, room - a};
  if (b <= half) return {room - b, b};
  return {half, half};
}

/// The margins between two that are there.
float gap(float a, float b) {
  return a > 0.0F && b > 0.0F ? panel_margin : 0.0F;
}

/// The widths of the left and the right column, as wanted.
std::pair<float, float> column_widths(const PanelSizes& wanted) {
  const auto width = [&](PanelPlace above, PanelPlace below) {
    return std::max(wanted[index_of(above)].x, wanted[index_of(below)].x);
  };
  return {width(PanelPlace::upper_left, PanelPlace::lower_left),
          width(PanelPlace::upper_right, PanelPlace::lower_right)};
}

}  // namespace

float columns_width(const PanelSizes& wanted) {
  const auto [left, right] = column_widths(wanted);
  return left + right + gap(left, right) + 2.0F * panel_margin;
}

PanelRectangles lay_out(glm::vec2 screen, const PanelSizes& wanted) {
  PanelRectangles placed;
  const auto want = [&](PanelPlace place) { return wanted[index_of(place)]; };
  const auto at = [&](PanelPlace place) -> Rectangle& { return placed[index_of(place)]; };
  const glm::vec2 room = glm::vec2(std::max(screen.x - 2.0F * panel_margin, 0.0F),
                                   std::max(screen.y - 2.0F * panel_margin, 0.0F));
  float upper = panel_margin, lower = panel_margin + room.y;
  for (const PanelPlace strip : {PanelPlace::top, PanelPlace::lowest, PanelPlace::bottom}) {
    const glm::vec2 size(std::min(want(strip).x, room.x), std::min(want(strip).y, room.y * strip_share_max));
    if (size.x <= 0.0F || size.y <= 0.0F) continue;
    const float y = strip == PanelPlace::top ? upper : lower - size.y;
    at(strip) = {{(screen.x - size.x) * 0.5F, y}, size};
    if (strip == PanelPlace::top) {
      upper += size.y + panel_margin;
    } else {
      lower -= size.y + panel_margin;
    }
  }
  const auto width = [&](PanelPlace above, PanelPlace below) {
    return std::max(want(above).x, want(below).x);
  };
  const float left = width(PanelPlace::upper_left, PanelPlace::lower_left);
  const float right = width(PanelPlace::upper_right, PanelPlace::lower_right);
  const auto [left_max, right_max] = share(room.x - gap(left, right), left, right);
  const auto column = [&](PanelPlace above, PanelPlace below, float width_max, bool on_the_right) {
    const float wanted_above = want(above).y, wanted_below = want(below).y;
    const auto [height_above, height_below] =
        share(lower - upper - gap(wanted_above, wanted_below), wanted_above, wanted_below);
    const auto put = [&](PanelPlace place, float height, float y) {
      const float x_size = std::min(want(place).x, width_max);
      if (x_size <= 0.0F || height <= 0.0F) return;
      at(place) = {{on_the_right ? panel_margin + room.x - x_size : panel_margin, y}, {x_size, height}};
    };
    put(above, height_above, upper);
    put(below, height_below, lower - height_below);
  };
  column(PanelPlace::upper_left, PanelPlace::lower_left, left_max, false);
  column(PanelPlace::upper_right, PanelPlace::lower_right, right_max, true);
  return placed;
}

bool intersect(const Rectangle& a, const Rectangle& b) {
  const glm::vec2 a_end = a.at + a.size, b_end = b.at + b.size;
  return a.size.x > 0.0F && b.size.x > 0.0F && a.size.y > 0.0F && b.size.y > 0.0F && a.at.x < b_end.x &&
         b.at.x < a_end.x && a.at.y < b_end.y && b.at.y < a_end.y;
}

}  // namespace scree
