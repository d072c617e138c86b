// What a window remembers from one time to the next: $XDG_CONFIG_HOME/scree/viewer.json, or
// ~/.config/scree/viewer.json. Flags and environment win over it.
#pragma once

#include <string>

#include "client/viewer/input/tool.h"
#include "client/viewer/session/overlay.h"
#include "client/viewer/viewing/options.h"

namespace scree {

struct HudChoice {
  bool help = true;
  bool graphs = false;
  bool panel = true;

  bool operator==(const HudChoice&) const = default;
};

struct Settings {
  int width = 1280;
  int height = 720;
  std::string method;  ///< empty: the first
  float view_radius_m = 96.0F;
  GridShape grid;
  HudChoice hud;
  OverlayChoice overlay;
  Tool tool;

  bool operator==(const Settings&) const = default;
};

/// Empty where there is neither XDG_CONFIG_HOME nor HOME: nothing is kept then.
std::string settings_file();

/// What the text says; what it does not say is as in `Settings{}`. An error names what is wrong; numbers out
/// of range, and names that nothing has, are wrong.
Result<Settings> parse_settings(const std::string& text);
std::string to_text(const Settings& settings);

/// Fills in what neither flags nor environment said.
void apply_settings(const Settings& settings, ViewerOptions& options);

/// The settings of one run of the viewer.
class KeptSettings {
 public:
  /// Reads the file, if there is one. One that cannot be understood is left as it is, and warned of on
  /// stderr.
  explicit KeptSettings(std::string file);

  const Settings& loaded() const { return loaded_; }
  /// Writes what changed since `start`; what a flag said, and nobody changed, is not remembered. Does nothing
  /// after a warning.
  void keep(const Settings& start, const Settings& end) const;

 private:
  std::string file_;  ///< empty: not to be written
  Settings loaded_;
};

}  // namespace scree
