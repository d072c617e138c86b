// Figures, graphs, a panel of methods and tools, help and messages over the picture, by Dear ImGui: what they
// say and how; hud_panels.h says where. Within a frame of a HudScreen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/viewer/viewing/hud_facts.h"
#include "client/viewer/viewing/settings.h"
#include "client/viewer/window/history.h"
#include "client/viewer/window/hud_panels.h"

namespace scree {

/// Milliseconds of the last frame.
struct FrameParts {
  float frame_ms = 0.0F;   ///< from one frame to the next
  float update_ms = 0.0F;  ///< messages applied, work shown and begun
  float draw_ms = 0.0F;    ///< the main thread's part of drawing
};

/// What the panel shows and changes.
struct PanelValues {
  Tool& tool;
  const Palette& palette;
  OverlayChoice& overlay;
  DrawOptionValues& method_options;
  bool& particles;
  bool& details;
  bool& shake;
  bool& predict;
  HandChoice& hand;
  std::optional<Quality>& quality;  ///< nothing: by the first frames
};

class Hud {
 public:
  /// Begins a frame, before any other of these. Panels take the mouse while the window does not hold it.
  void begin(bool mouse_is_free);
  /// Remembers a frame for the graphs, shown or not.
  void note(const HudFacts& facts, const FrameParts& parts);
  /// A few lines; with `all`, everything that is known.
  void figures(const HudFacts& facts, bool all);
  /// On the lower right: who is in the world, and graphs; either may be left out.
  void lower_right(const HudFacts& facts, const PersonsMessage* persons, const PersonColours& colours,
                   bool graphs);
  /// The chosen method; null if none was chosen. Sliders and boxes change the values.
  const MethodEntry* panel(const MethodEntry& chosen, const PanelValues& values);
  void help(Telling telling, bool gamepad, ControlsOf of);
  /// Above everything: what must not be overlooked.
  void banner(const std::string& text);
  /// Below everything: a method that is being made ready, and what there is to say now, a line each; where
  /// there is no room for all lines, the last ones. Nothing when there is nothing.
  void messages(const HudFacts& facts, const std::vector<std::string>& lines);
  /// Below everything else, in a replay: its events, where it stands, and the controls that move it. Nothing
  /// before it is known.
  void timeline(Timeline& timeline, double now_s);
  /// The persons' names, over their figures in the picture, but for one through whose eye one looks.
  void names(const Figures& figures, const glm::mat4& view_projection,
             std::optional<uint64_t> looked_through = {});
  /// `refused`: something was, and its words stand in the messages.
  void crosshair(bool refused);

  const HudPanels& panels() const { return panels_; }
  /// Height of the next frame's text, pixels, at the person's scale, or less where panels need it.
  int text_px(float text_scale);

 private:
  void graphs(const HudFacts& facts);

  HudPanels panels_;
  History frame_;
  History update_;
  History draw_;
  History network_;
  History tick_;
};

}  // namespace scree
