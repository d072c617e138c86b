// The viewer's options, from the command line, the environment and a preset (shared/base/preset.h).
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "client/cache/rejoin.h"
#include "client/connection/endpoint.h"
#include "client/render/methods.h"
#include "client/render/scene/camera.h"
#include "client/render/scene/quality.h"
#include "client/viewer/pictures/camera_path.h"
#include "client/viewer/pictures/screenshots.h"
#include "client/viewer/session/overlay.h"
#include "shared/fracture/seed_pattern.h"

namespace scree {

/// A value of --quality and the settings, beside the presets' names: the first frames decide.
inline constexpr std::string_view auto_name = "auto";

struct ViewerOptions : ServerEndpoint {
  std::string name;  ///< the person's
  CacheConfig cache{};
  int width = 1280;
  int height = 720;
  Camera camera;
  /// Options that a flag, the environment or a preset sets.
  struct Given {
    bool size = false;
    bool camera = false;
    bool method = false;
    bool view_radius = false;
    bool render_scale = false;
    bool quality = false;
    std::set<std::string_view> method_options;  ///< by name
    bool particles = false;
    bool details = false;
    bool shake = false;
    bool predict = false;
    bool sound = false;
  } given;
  std::optional<uint16_t> past_port;    ///< of a server on the same host that replays this one's recording
  OverlayChoice overlay;                ///< shown from the start, and in pictures
  const MethodEntry* method = nullptr;  ///< never null once parsed
  std::optional<Quality> quality;       ///< nothing: by the first frames (AutoQuality)
  float view_radius_m = 0.0F;           ///< if given, instead of the quality's, as the next
  float render_scale = 1.0F;
  DrawOptionValues method_options;     ///< the methods' own
  bool particles = true;               ///< dust, grit and splinters
  bool details = true;                 ///< grass, bushes and stones, where the quality has them
  bool shake = true;                   ///< blows shake the eye, in a window
  std::optional<SeedPattern> pattern;  ///< of the tool's pieces, in a window; nothing: as it was kept
  bool sound = false;                  ///< by the device, in a window
  std::string sound_file;              ///< WAV of what there is to hear; empty: none
  bool predict = true;                 ///< carves are shown before the server answers
  bool offscreen = false;
  bool gl_debug = false;
  double timeout_s = 0.0;
  std::vector<ScreenshotOrder> screenshots;
  std::string path_file;           ///< empty: none
  std::optional<CameraPath> path;  ///< of that file
  double frames_per_s = 0.0;       ///< of the path, offscreen
  std::string frames;              ///< folder for every frame of the path as a picture; empty: none
  bool time_demo = false;
  std::string reference;  ///< picture to compare the screenshot with; empty: none
  double threshold = 0.0;
  std::string trace_file;  ///< file of the trace; empty: none
};

/// The program should end now with this status; its output is printed.
struct ExitNow {
  int status = 0;
};

std::variant<ViewerOptions, ExitNow> parse_options(int argc, const char* const* argv);

}  // namespace scree
