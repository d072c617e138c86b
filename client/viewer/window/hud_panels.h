// The HUD's panels as Dear ImGui's windows without frames, each in its place (layout.h). A panel's size is
// what its content took in the frame before; in its first frame a panel is measured and not seen.
#pragma once

#include "client/viewer/window/layout.h"

namespace scree {

class HudPanels {
 public:
  static constexpr float fit_min = 0.7F;  ///< nine pixels, the least that can be read

  /// Begins a frame of that size, pixels. Panels may be used by the mouse, if it is free.
  void begin_frame(glm::vec2 screen, bool mouse_is_free);
  /// What follows, up to end(), is in the panel; one panel a frame in each place.
  void begin(PanelPlace place);
  void end();

  /// Of the panels begun in this frame; empty where there is none, or none seen yet.
  const PanelRectangles& rectangles() const { return seen_; }
  /// By how much the text should be smaller, so that both columns fit beside each other: from fit_min to 1.
  float fit() const { return fit_; }
  /// Whether the panel there had less room than it wants, in this frame.
  bool scrolls(PanelPlace place) const;

 private:
  PanelSizes wanted_{};       ///< by the panels of the last frame
  PanelSizes measured_{};     ///< in this frame
  PanelRectangles placed_{};  ///< in this frame
  PanelRectangles seen_{};
  float fit_ = 1.0F;           ///< for the next frame
  float measured_fit_ = 1.0F;  ///< of the text in `measured_`
  PanelPlace open_ = PanelPlace::top;
  bool mouse_is_free_ = false;
};

}  // namespace scree
