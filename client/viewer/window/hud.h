// Figures, graphs, a panel of methods and tools, help and messages over the picture, by Dear ImGui. Needs the
// window's GL context current.
#pragma once

#include "client/viewer/viewing/settings.h"
#include "client/viewer/window/app_window.h"
#include "client/viewer/window/history.h"
#include "client/viewer/window/hud_facts.h"

namespace scree {

/// Milliseconds of the last frame.
struct FrameParts {
  float frame_ms = 0.0F;   ///< from one frame to the next
  float update_ms = 0.0F;  ///< messages applied, work shown and begun
  float draw_ms = 0.0F;    ///< the main thread's part of drawing
};

class Hud {
 public:
  explicit Hud(const AppWindow& window);
  ~Hud();
  Hud(const Hud&) = delete;
  Hud& operator=(const Hud&) = delete;

  /// Begins a frame, before any other of these. The panel takes the mouse while the window does not hold it.
  void begin(bool mouse_is_free);
  /// Remembers a frame for the graphs, shown or not.
  void note(const HudFacts& facts, const FrameParts& parts);
  void figures(const HudFacts& facts);
  void graphs(const HudFacts& facts);
  /// The chosen method; null if none was chosen. Sliders and boxes change the others.
  const MethodEntry* panel(const MethodEntry& chosen, Tool& tool, OverlayChoice& overlay, GridShape& grid,
                           bool& predict);
  /// The persons' names, where their cursors are in the picture.
  void names(const std::vector<PlayerCursor>& cursors, const glm::mat4& view_projection);
  void help();
  void crosshair();
  void banner(const std::string& text);
  void end();

 private:
  History frame_;
  History update_;
  History draw_;
  History network_;
  History tick_;
  bool mouse_is_free_ = false;
};

}  // namespace scree
