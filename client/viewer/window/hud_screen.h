// Dear ImGui's frame: over a window, or on nothing at all, for tests. Used by the HUD only; one at a time, on
// the main thread.
#pragma once

#include <glm/vec2.hpp>

#include "client/viewer/window/app_window.h"

namespace scree {

class HudScreen {
 public:
  /// Needs the window's GL context current, as all calls then do.
  explicit HudScreen(const AppWindow& window);
  /// A screen of that size, pixels; its drawing goes nowhere.
  explicit HudScreen(glm::vec2 size);
  ~HudScreen();
  HudScreen(const HudScreen&) = delete;
  HudScreen& operator=(const HudScreen&) = delete;

  /// `mouse_is_free`: it may be used on panels. `text_px`: height of the text.
  void begin(bool mouse_is_free, int text_px);
  void end();

  /// Height of the text in this frame, pixels: as it is shown, and as its letters were made.
  static float shown_px();
  static float made_px();

 private:
  void make_font(int text_px);

  bool has_window_;
  int text_px_ = 0;  ///< of the letters that are made
};

}  // namespace scree
