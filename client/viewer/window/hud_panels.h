// The HUD's panels as Dear ImGui's windows without frames, each in its place (layout.h). A panel's size is
// what its content took in the frame before; in its first frame a panel is measured and not seen.
#pragma once

#include "client/viewer/window/layout.h"

namespace scree {

class HudPanels {
 public:
  static constexpr int text_px_min = 9;  ///< the least height that can be read

  /// Height of the text of the next frame, pixels: as asked for, or less, so that both columns fit beside
  /// each other; not below text_px_min, unless that is asked for.
  int text_px(int asked);
  /// Begins a frame of that size, pixels. Panels may be used by the mouse, if it is free.
  void begin_frame(glm::vec2 screen, bool mouse_is_free);
  /// What follows, up to end(), is in the panel; one panel a frame in each place.
  void begin(PanelPlace place);
  void end();

  /// The rectangles of the panels begun in this frame; empty where there is none, or none seen yet.
  const PanelRectangles& rectangles() const { return seen_; }
  /// Where panels like those of the last frame stand in this one, begun or not.
  const PanelRectangles& places() const { return placed_; }
  /// Whether the panel there had less height than it wants, in this frame; or less width, which hides the
  /// ends of its lines.
  bool scrolls(PanelPlace place) const;
  bool clips(PanelPlace place) const;

 private:
  void fit_text(glm::vec2 screen);

  PanelSizes wanted_{};       ///< by the panels of the last frame
  PanelSizes measured_{};     ///< in this frame
  PanelRectangles placed_{};  ///< in this frame
  PanelRectangles seen_{};
  int asked_px_ = 0;
  int fitting_px_ = 0;         ///< height of text that fits; as asked for, when something else is shown
  float measured_px_ = 0.0F;   ///< of the text in `measured_`
  glm::vec2 screen_{0.0F};     ///< of the last frame
  unsigned shown_places_ = 0;  ///< in it, a bit for each
  PanelPlace open_ = PanelPlace::top;
  bool mouse_is_free_ = false;
};

}  // namespace scree
