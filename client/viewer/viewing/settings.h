// The settings that a window keeps between runs: in $XDG_CONFIG_HOME/scree/viewer.json, or
// ~/.config/scree/viewer.json. Flags and environment take precedence.
#pragma once

#include <string>

#include "client/viewer/input/hand_choice.h"
#include "client/viewer/input/tool.h"
#include "client/viewer/session/overlay.h"
#include "client/viewer/viewing/options.h"

namespace scree {

struct HudChoice {
  Telling help = Telling::nothing;
  bool figures = false;
  bool graphs = false;
  bool panel = false;
  bool persons = false;
  bool all_figures = false;  ///< a developer's

  bool operator==(const HudChoice&) const = default;
};

struct Settings {
  int width = 1280;
  int height = 720;
  std::string method;              ///< empty: the first
  std::optional<Quality> quality;  ///< nothing: by the first frames
  DrawOptionValues method_options;
  HudChoice hud;
  HandChoice hand;
  OverlayChoice overlay;
  Tool tool;
  bool particles = true;
  bool details = true;
  bool shake = true;
  bool predict = true;
  bool sound = true;  ///< by the device

  bool operator==(const Settings&) const = default;
};

/// Empty without XDG_CONFIG_HOME and HOME: then nothing is kept.
std::string settings_file();

/// The settings in the text; missing ones are those of `Settings{}`. An error names the wrong one: a number
/// out of range, or an unknown name.
Result<Settings> parse_settings(const std::string& text);
std::string to_text(const Settings& settings);

/// Fills in the options that neither flags nor environment set.
void apply_settings(const Settings& settings, ViewerOptions& options);

/// The settings of one run of the viewer.
class SettingsFile {
 public:
  /// Reads the file, if there is one. Leaves an invalid file unchanged, with a warning on stderr.
  explicit SettingsFile(std::string file);

  const Settings& loaded() const { return loaded_; }
  /// Writes the settings that changed since `start`; an unchanged value from a flag is not kept. Does nothing
  /// after a warning.
  void save(const Settings& start, const Settings& end) const;

 private:
  std::string file_;  ///< empty: not to be written
  Settings loaded_;
};

}  // namespace scree
