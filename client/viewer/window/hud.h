// Figures, graphs, a panel of methods and tools, help and messages over the picture, by Dear ImGui: what they
// say and how; hud_panels.h says where. Within a frame of a HudScreen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/viewer/signs/shown_signs.h"
#include "client/viewer/viewing/hud_facts.h"
#include "client/viewer/viewing/settings.h"
#include "client/viewer/viewing/tool_preview.h"
#include "client/viewer/window/app_window.h"
#include "client/viewer/window/history.h"
#include "client/viewer/window/hud_panels.h"

namespace scree {

/// Milliseconds of the last frame.
struct FrameParts {
  float frame_ms = 0.0F;   ///< from one frame to the next
  float update_ms = 0.0F;  ///< messages applied, work shown and begun
  float draw_ms = 0.0F;    ///< the main thread's part of drawing
};

/// In the order of the menu's buttons.
enum class MenuChoice : uint8_t { go_on = 0, tell_keys = 1, end = 2, none = 3 };

/// Whose panel it is: a replay has no tool, and a developer chooses how it is drawn.
struct PanelOf {
  bool replay = false;
  bool developer = false;
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
  /// A few lines; with `all`, everything that a developer wants to know.
  void figures(const HudFacts& facts, bool all);
  /// Lowest: what a click does, and what one carries. Its buttons change the tool.
  void tool_line(Tool& tool, const std::optional<ToolAim>& aim, const HudFacts& facts,
                 const Palette& palette);
  /// On the lower right: who is in the world, and graphs; either may be left out.
  void lower_right(const HudFacts& facts, const PersonsMessage* persons, const PersonColours& colours,
                   bool graphs);
  /// The chosen method; null if none was chosen. Sliders and boxes change the values.
  const MethodEntry* panel(const MethodEntry& chosen, const PanelValues& values, PanelOf of);
  void help(Telling telling, bool gamepad, ControlsOf of);
  /// Above everything: the connection is lost, and when the next attempt is. True: its button wants it now.
  bool lost(const HudFacts& facts);
  /// Below everything: a method that is being made ready, and what there is to say now, a line each; where
  /// there is no room for all lines, the last ones. Nothing when there is nothing.
  void messages(const HudFacts& facts, const std::vector<std::string>& lines);
  /// Below everything else, in a replay: its events, where it stands, and the controls that move it. Nothing
  /// before it is known.
  void timeline(Timeline& timeline, double now_s);
  /// The persons' names, over their figures in the picture, but for one through whose eye one looks.
  void names(const Figures& figures, const glm::mat4& view_projection,
             std::optional<uint64_t> looked_through = {});
  /// What a game shows: lines and bars above, markers at their places. Nothing where there is none.
  void signs(const std::vector<ShownSign>& shown);
  /// In the middle: the cross, and what became of the last strike.
  void crosshair(const HudFacts& facts);
  /// In the middle, over everything else, for mouse and keyboard.
  /// `note`: below the buttons; may be empty.
  MenuChoice menu(MenuKeys& keys, std::string_view note);

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
