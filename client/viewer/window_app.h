// A window on a session: handles input and draws, frame by frame. Needs the window's GL context current.
#pragma once

#include <optional>

#include "client/viewer/input/repeat.h"
#include "client/viewer/pictures/path_recorder.h"
#include "client/viewer/session/hints.h"
#include "client/viewer/session/whereabouts.h"
#include "client/viewer/viewing/settings.h"
#include "client/viewer/viewing/viewing.h"
#include "client/viewer/window/app_window.h"
#include "client/viewer/window/hud.h"
#include "client/viewer/window/hud_screen.h"

namespace scree {

class WindowApp {
 public:
  /// `window` and `viewing` must outlive the app. `hints`: what the person was told so far. `rewinds`: a
  /// replay plays backwards from its end.
  WindowApp(AppWindow& window, Viewing& viewing, const Settings& loaded, const Hints& hints = {},
            bool rewinds = false);

  /// From the person's input to the picture.
  Result<void> frame();
  /// The current settings, to be kept.
  Settings settings() const;
  const Hints& hints() const { return hints_; }
  /// The person wants to look back at this world, or to come back from there (ViewerOptions::past_port).
  bool leaves() const { return leaves_; }
  /// Rather than walks.
  bool flies() const { return !whereabouts_.walks(); }
  /// Through whose eye the person looks.
  const FollowedEye& eye() const { return whereabouts_.eye(); }
  /// Where the panels stood in the last frame.
  const PanelRectangles& panels() const { return hud_.panels().rectangles(); }

 private:
  void follow_path(double now_s);
  Result<void> act(const AppInput& input, double now_s);
  void strike(const AppInput& input, double now_s);
  void act_on_session(Action action, double now_s);
  void rewind();
  void choose(MenuChoice choice);
  Result<void> choose(const MethodEntry& method);
  void change_hand(Action action, double now_s);
  void act_on_view(Action action);
  void mute_or_play(double now_s);
  Result<void> act_on_files(Action action, double now_s);
  void record_path(double now_s);
  void end_path(double now_s);
  /// Draws by the preset that is wanted, or by that which the first frames suggest.
  void choose_quality(float frame_ms, double now_s);
  void say(const std::string& text, double now_s);
  std::vector<std::string> messages(double now_s);
  std::string hint(double now_s);
  Result<void> draw_hud(const FrameParts& parts, double now_s);

  AppWindow& window_;
  Viewing& viewing_;
  HudScreen screen_;
  Hud hud_;
  HudChoice choice_;
  bool hidden_ = false;  ///< all of the HUD
  HandChoice hand_;
  OverlayChoice overlay_;
  Tool tool_;
  Repeat strike_;
  Hints hints_;
  bool rewinds_;
  bool leaves_ = false;
  Whereabouts whereabouts_;
  DrawOptionValues method_options_;
  bool particles_;
  bool details_;
  bool shake_;
  bool predict_;
  bool sound_;
  std::optional<Quality> quality_;  ///< as chosen; nothing: by the first frames
  FactFinder facts_;
  std::optional<double> path_begun_s_;
  std::optional<PathRecorder> recorder_;
  std::string said_;  ///< by this program to the person, until some moment
  double said_until_s_ = 0.0;
};

}  // namespace scree
