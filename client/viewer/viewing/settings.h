// The settings that a window keeps between runs: in $XDG_CONFIG_HOME/scree/viewer.json, or
// ~/.config/scree/viewer.json. Flags and environment take precedence.
#pragma once

#include <string>

#include "client/viewer/input/tool.h"
#include "client/viewer/session/overlay.h"
#include "client/viewer/viewing/options.h"

namespace scree {

struct HudChoice {
  Telling help = Telling::basics;
  bool figures = false;  ///< all of them
  bool graphs = false;
  bool panel = true;
  bool persons = false;

  bool operator==(const HudChoice&) const = default;
};

inline constexpr float field_of_view_min_degrees = 20.0F;  ///< vertical
inline constexpr float field_of_view_max_degrees = 110.0F;
inline constexpr float mouse_speed_min = 0.1F;
inline constexpr float mouse_speed_max = 10.0F;
inline constexpr float text_scale_min = 0.5F;
inline constexpr float text_scale_max = 4.0F;

/// How a person looks and reads.
struct HandChoice {
  float field_of_view_degrees = 60.0F;
  float mouse_speed = 1.0F;  ///< 1: a seventh of a degree a pixel
  float text_scale = 1.0F;

  bool operator==(const HandChoice&) const = default;
};

/// Changes the choice, if the action concerns it.
void change(HandChoice& choice, Action action);

struct Settings {
  int width = 1280;
  int height = 720;
  std::string method;              ///< empty: the first
  std::optional<Quality> quality;  ///< nothing: by the first frames
  GridShape grid;
  HudChoice hud;
  HandChoice hand;
  OverlayChoice overlay;
  Tool tool;
  bool particles = true;
  bool predict = true;

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
class KeptSettings {
 public:
  /// Reads the file, if there is one. Leaves an invalid file unchanged, with a warning on stderr.
  explicit KeptSettings(std::string file);

  const Settings& loaded() const { return loaded_; }
  /// Writes the settings that changed since `start`; an unchanged value from a flag is not kept. Does nothing
  /// after a warning.
  void keep(const Settings& start, const Settings& end) const;

 private:
  std::string file_;  ///< empty: not to be written
  Settings loaded_;
};

}  // namespace scree
