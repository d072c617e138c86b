#include "client/viewer/viewing/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "client/cache/cache_options.h"
#include "client/cache/limits.h"
#include "client/connection/endpoint_options.h"
#include "client/render/draw_flags.h"
#include "client/viewer/base/camera_text.h"
#include "client/viewer/base/limits.h"
#include "client/viewer/input/actions.h"
#include "client/viewer/input/tool.h"
#include "client/viewer/pictures/picture_size.h"
#include "shared/base/option_check.h"
#include "shared/base/preset.h"

namespace scree {
namespace {

/// Over the canyon floor, looking at the cliff and the arch: where a server of an older release says no
/// spawn.
constexpr const char* default_camera = "30,9,19,63,-7";

Result<void> understand_place(const std::string& size, const std::string& camera, ViewerOptions& options) {
  const Result<PictureSize> pixels = parse_size(size);
  if (!pixels) return fail("--size: " + pixels.error().message);
  options.width = pixels->width;
  options.height = pixels->height;
  const Result<Camera> place = parse_camera(camera);
  if (!place) return fail("--camera: " + place.error().message);
  options.camera = *place;
  return {};
}

/// The options as text, before parsing.
struct Texts {
  std::string size = "1280x720";
  std::string camera = default_camera;
  std::string method{all_methods().front().name};
  std::string quality{auto_name};
  std::map<const DrawOption*, std::string> method_options;
  std::string preset;   ///< empty: none
  std::string pattern;  ///< empty: as it was kept
  std::vector<std::string> screenshots;
};

void declare_preset(CLI::App& app, Texts& texts) {
  app.add_option("--preset", texts.preset,
                 "Values for a kind of machine; options that you give override them:\n" +
                     describe_presets(viewer_presets, viewer_preset_options))
      ->envname("SCREE_PRESET");
}

void declare_view(CLI::App& app, ViewerOptions& options, Texts& texts) {
  app.add_option("--name", options.name, "Your name, as others see it at your cursor")->envname("SCREE_NAME");
  app.add_option("--size", texts.size, "Window or image, WIDTHxHEIGHT")->envname("SCREE_SIZE");
  app.add_option("--camera", texts.camera,
                 "x,y,z,yaw,pitch in metres and degrees; yaw 0 looks along -z and grows to the left; "
                 "default: the world's spawn")
      ->envname("SCREE_CAMERA")
      ->default_str("");
  app.add_option("--method", texts.method, "Drawing method:\n" + describe_methods())->envname("SCREE_METHOD");
  app.add_option("--quality", texts.quality,
                 "Quality: low, medium, high, or auto, which chooses by the time of the first frames "
                 "(without a window: high)")
      ->envname("SCREE_QUALITY");
  bounded(app.add_option("--view-radius", options.view_radius_m,
                         "Distance of detailed terrain, metres; default: by the quality"),
          {limits::view_radius_min_m, limits::view_radius_max_m})
      ->envname("SCREE_VIEW_RADIUS");
  bounded(app.add_option("--render-scale", options.render_scale,
                         "Pixels drawn along a side for each pixel shown; default: by the quality; only "
                         "raymarch accepts more than 1"),
          {limits::render_scale_min, limits::render_scale_max})
      ->envname("SCREE_RENDER_SCALE");
  for (const DrawOption* option : all_draw_options())
    add_draw_option(app, *option, texts.method_options[option])->envname(variable_of(*option));
}

std::array<std::string_view, tool_patterns.size()> names_of_patterns() {
  std::array<std::string_view, tool_patterns.size()> names{};
  std::ranges::transform(tool_patterns, names.begin(), name_of<SeedPattern>);
  return names;
}

void declare_input(CLI::App& app, ViewerOptions& options, Texts& texts) {
  app.add_option("--pattern", texts.pattern,
                 "Pattern of the pieces of your carves: " + listed(names_of_patterns()) +
                     "; key R changes it (only in a window)")
      ->envname("SCREE_PATTERN");
  bounded(
      app.add_option("--past", options.past_port,
                     "TCP port, on the same host, of a server that replays the recording of this one: key J "
                     "rewinds (only in a window)"),
      {1, 65535})
      ->envname("SCREE_PAST");
  app.add_option("--predict", options.predict,
                 "Show your own carves at once, before the server answers: true or false")
      ->envname("SCREE_PREDICT");
  app.add_option("--particles", options.particles,
                 "Show dust, grit and splinters where rock breaks, strikes and settles: true or false")
      ->envname("SCREE_PARTICLES");
  app.add_option("--details", options.details,
                 "Show grass, bushes and stones on the ground, where the quality has them: true or false")
      ->envname("SCREE_DETAILS");
  app.add_option("--shake", options.shake, "Blows shake the eye, in a window: true or false")
      ->envname("SCREE_SHAKE");
  app.add_option("--sound", options.sound,
                 "Play the sounds of rock that breaks, strikes and settles, in a window with a sound device: "
                 "true or false; key 6 changes it")
      ->envname("SCREE_SOUND");
  app.add_option("--sound-file", options.sound_file,
                 "FILE (WAV) for the sound at the camera, written until the program ends")
      ->envname("SCREE_SOUND_FILE")
      ->check(check_writable, "FILE");
}

void declare_pictures(CLI::App& app, ViewerOptions& options, Texts& texts) {
  app.add_flag("--offscreen", options.offscreen, "Open no window: take the screenshots, then exit")
      ->envname("SCREE_OFFSCREEN");
  app.add_option(
         "--screenshot", texts.screenshots,
         "FILE[@WHEN], a PNG; repeatable. WHEN: joined (default), after=N (seconds later), pieces>=N (that "
         "many pieces are in sight), settled (something was carved, and all pieces are terrain again)")
      ->envname("SCREE_SCREENSHOT");
  app.add_option(
         "--path", options.path_file,
         "FILE with key frames of the camera (JSON, client/viewer/pictures/camera_path.h): fly along it")
      ->envname("SCREE_PATH");
  app.add_option("--frames", options.frames, "Offscreen: DIR for every frame of the path, as PNG")
      ->envname("SCREE_FRAMES");
  bounded(app.add_option("--fps", options.frames_per_s, "Offscreen: frames a second of the path"),
          {1.0, 1000.0})
      ->envname("SCREE_FPS");
  app.add_flag("--timedemo", options.time_demo,
               "Offscreen: draw the path's frames as fast as possible, print their times as a line of JSON")
      ->envname("SCREE_TIMEDEMO");
  app.add_option("--reference", options.reference,
                 "Offscreen: PNG to compare the screenshot with; prints the difference, and exits with "
                 "status 3 if it is above --threshold")
      ->envname("SCREE_REFERENCE");
  bounded(app.add_option("--threshold", options.threshold,
                         "Root mean square of the difference of all colour values, 0 (equal) to 1"),
          {0.0, 1.0})
      ->envname("SCREE_THRESHOLD");
}

void declare(CLI::App& app, ViewerOptions& options, Texts& texts) {
  declare_preset(app, texts);
  declare_view(app, options, texts);
  declare_input(app, options, texts);
  declare_pictures(app, options, texts);
  app.add_flag("--overlay", options.overlay.shown,
               "Show borders, interest, bodies, contacts and other persons' cursors over the picture")
      ->envname("SCREE_OVERLAY");
  bounded(app.add_option("--timeout", options.timeout_s,
                         "Offscreen: seconds to wait for the next picture or frame before giving up"),
          {0.001, 86400.0})
      ->envname("SCREE_TIMEOUT");
  app.add_option(
         "--trace", options.trace_file,
         "FILE for the times of all work, written at the end; chrome://tracing and ui.perfetto.dev open it")
      ->envname("SCREE_TRACE")
      ->check(check_writable, "FILE");
  app.add_flag("--gl-debug", options.gl_debug, "Ask for a debug context, and fail on any OpenGL error")
      ->envname("SCREE_GL_DEBUG");
  app.footer("Keys, mouse and gamepad:\n" + describe_controls(Telling::all, true, ControlsOf::both));
}

Result<void> understand_pictures(ViewerOptions& options) {
  const bool every_frame = !options.frames.empty() || options.time_demo;
  if (every_frame && (!options.offscreen || options.path_file.empty()))
    return fail("--frames and --timedemo need --offscreen and --path FILE");
  if (!options.reference.empty() && (!options.offscreen || options.screenshots.size() != 1))
    return fail("--reference needs --offscreen and exactly one --screenshot FILE to compare");
  if (options.offscreen && options.screenshots.empty() && !every_frame)
    return fail("--offscreen needs --screenshot FILE, --frames DIR or --timedemo");
  if (options.path_file.empty()) return {};
  Result<CameraPath> path = CameraPath::read(options.path_file);
  if (!path) return fail(path.error().message);
  options.path = std::move(*path);
  return {};
}

Result<void> apply_preset(CLI::App& app, const std::string& name) {
  if (name.empty()) return {};
  const std::optional<Preset> preset = kind_named<Preset>(name);
  if (preset && !is_for_viewers(*preset))
    return fail("--preset: " + name + " is " + std::string(traits_of(*preset).machine));
  if (!preset)
    return fail("--preset: there is no '" + name + "'; there are\n" +
                describe_presets(viewer_presets, viewer_preset_options));
  apply_preset(app, *preset, viewer_preset_options);
  return {};
}

Result<void> understand_pattern(const std::string& name, ViewerOptions& options) {
  if (name.empty()) return {};
  options.pattern = kind_named<SeedPattern>(name);
  if (options.pattern && asks_no_points(*options.pattern)) return {};
  return fail("--pattern: there is no '" + name + "'; there are " + listed(names_of_patterns()));
}

Result<void> understand(const Texts& texts, ViewerOptions& options) {
  TRY(understand_place(texts.size, texts.camera, options));
  options.method = method_named(texts.method);
  if (options.method == nullptr)
    return fail("--method: there is no '" + texts.method + "'; there are\n" + describe_methods());
  if (texts.quality != auto_name) {
    options.quality = kind_named<Quality>(texts.quality);
    if (!options.quality)
      return fail("--quality: there is no '" + texts.quality + "'; there are auto, " +
                  listed(kind_names<Quality>));
  }
  TRY(understand_pattern(texts.pattern, options));
  options.method_options = values_of_texts(texts.method_options);
  for (const std::string& text : texts.screenshots) {
    Result<ScreenshotOrder> order = parse_screenshot(text);
    if (!order) return fail(order.error().message);
    if (Result<void> writable = can_be_written(order->file); !writable)
      return fail("--screenshot: " + writable.error().message);
    options.screenshots.push_back(std::move(*order));
  }
  return understand_pictures(options);
}

}  // namespace

std::variant<ViewerOptions, ExitNow> parse_options(int argc, const char* const* argv) {
  ViewerOptions options;
  options.view_radius_m = traits_of(Quality::high).view_radius_m;
  if (const char* user = std::getenv("USER")) options.name = user;
  options.timeout_s = 120.0;
  options.sound = true;
  options.frames_per_s = 30.0;
  options.threshold = 0.01;
  Texts texts;
  CLI::App app("Shows a Scree server's terrain, live or replayed, and carves it.", "scree-viewer");
  app.set_version_flag("--version", SCREE_VERSION);
  app.option_defaults()->always_capture_default();
  EndpointOptions endpoint(app, options);
  CacheOptions cache(app, options.cache, limits::cache_mib_default);
  declare(app, options, texts);
  Result<void> understood;
  try {
    app.parse(argc, argv);
    understood = apply_preset(app, texts.preset);
    const auto given = [&](const std::string& name) { return app.get_option(name)->count() > 0; };
    options.given = {.size = given("--size"),
                     .camera = given("--camera"),
                     .method = given("--method"),
                     .view_radius = given("--view-radius"),
                     .render_scale = given("--render-scale"),
                     .quality = given("--quality"),
                     .method_options = {},
                     .particles = given("--particles"),
                     .details = given("--details"),
                     .shake = given("--shake"),
                     .predict = given("--predict"),
                     .sound = given("--sound")};
    for (const DrawOption* option : all_draw_options())
      if (given("--" + std::string(option->name))) options.given.method_options.insert(option->name);
  } catch (const CLI::ParseError& error) {
    return ExitNow{app.exit(error) == 0 ? 0 : 2};
  }
  cache.complete();
  if (const Result<void> kept = cache.try_folder(); !kept)
    std::fprintf(stderr, "scree-viewer: warning: %s\n", kept.error().message.c_str());
  if (understood) understood = endpoint.complete();
  if (understood) understood = understand(texts, options);
  if (!understood) {
    std::fprintf(stderr, "scree-viewer: %s\n", understood.error().message.c_str());
    return ExitNow{2};
  }
  return options;
}

}  // namespace scree
