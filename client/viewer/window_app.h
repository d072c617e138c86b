// A window on a session: handles input and draws, frame by frame. Needs the window's GL context current.
#pragma once

#include <optional>

#include "client/viewer/viewing/settings.h"
#include "client/viewer/viewing/viewing.h"
#include "client/viewer/window/app_window.h"
#include "client/viewer/window/hud.h"

namespace scree {

class WindowApp {
 public:
  /// `window` and `viewing` must outlive the app.
  WindowApp(AppWindow& window, Viewing& viewing, const Settings& kept);

  /// From the person's input to the picture.
  Result<void> frame();
  /// The current settings, to be kept.
  Settings settings() const;

 private:
  void follow_path(double now_s);
  Result<void> act(const AppInput& input, double now_s);
  Result<void> choose(const MethodEntry& method);
  /// Lines over the world: the shape of the next strike, other persons, the overlay.
  LineList lines(double now_s);
  Result<void> draw_hud(const FrameParts& parts, double now_s);

  AppWindow& window_;
  Viewing& viewing_;
  Hud hud_;
  HudChoice choice_;
  OverlayChoice overlay_;
  Tool tool_;
  GridShape grid_;
  bool predict_;
  FactFinder facts_;
  std::optional<double> path_begun_s_;
};

}  // namespace scree
