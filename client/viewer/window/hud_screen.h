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
  /// Of that size, pixels; what is drawn goes nowhere.
  explicit HudScreen(glm::vec2 size);
  ~HudScreen();
  HudScreen(const HudScreen&) = delete;
  HudScreen& operator=(const HudScreen&) = delete;

  /// `mouse_is_free`: it may be used on panels. `text_scale`: 1 is 13 pixels.
  void begin(bool mouse_is_free, float text_scale);
  void end();

 private:
  bool has_window_;
};

}  // namespace scree
