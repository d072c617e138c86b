#include "client/viewer/options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "client/viewer/limits.h"
#include "proto/messages.h"

namespace scree {
namespace {

constexpr float radians_per_degree = 0.01745329F;
constexpr float pitch_max_degrees = 89.0F;

/// Over the canyon floor, looking at the cliff and the arch.
constexpr const char* default_camera = "30,9,19,63,-7";

Result<void> parse_size(const std::string& text, ViewerOptions& options) {
  std::istringstream in(text);
  char x = 0;
  if (!(in >> options.width >> x >> options.height) || x != 'x' || !in.eof() || options.width < 1 ||
      options.height < 1)
    return fail("--size: '" + text + "' is no size; write it as 1280x720");
  if (std::max(options.width, options.height) > limits::image_side_max)
    return fail("--size: '" + text + "' is over " + std::to_string(limits::image_side_max) +
                " pixels a side (limits.image_side_max)");
  return {};
}

Result<void> parse_camera(const std::string& text, Camera& camera) {
  std::istringstream in(text);
  float v[5];
  for (int i = 0; i < 5; ++i) {
    char comma = ',';
    if ((i > 0 && !(in >> comma)) || comma != ',' || !(in >> v[i]) || !std::isfinite(v[i]))
      return fail("--camera: '" + text +
                  "' is no place to look from; write x,y,z,yaw,pitch (metres, degrees)");
  }
  if (in.peek() != std::istringstream::traits_type::eof())
    return fail("--camera: '" + text + "' has more than x,y,z,yaw,pitch");
  if (std::abs(v[0]) > limits::world_half_width_m || std::abs(v[2]) > limits::world_half_width_m ||
      std::abs(v[1]) > limits::world_half_height_m)
    return fail("--camera: '" + text +
                "' is outside the world (limits.world_half_width_m, world_half_height_m)");
  camera.eye_m = {v[0], v[1], v[2]};
  camera.yaw = v[3] * radians_per_degree;
  camera.pitch = std::clamp(v[4], -pitch_max_degrees, pitch_max_degrees) * radians_per_degree;
  return {};
}

/// The options as text, before they are understood.
struct Texts {
  std::string size = "1280x720";
  std::string camera = default_camera;
  std::string method{all_methods().front().name};
  std::vector<std::string> screenshots;
};

void declare(CLI::App& app, ViewerOptions& options, Texts& texts) {
  app.add_option("--host", options.host, "Server's name or address")->envname("SCREE_HOST");
  app.add_option("--port", options.port, "Server's TCP port")
      ->envname("SCREE_PORT")
      ->check(CLI::Range(1, 65535));
  app.add_option("--size", texts.size, "Window or image, WIDTHxHEIGHT")->envname("SCREE_SIZE");
  app.add_option("--camera", texts.camera,
                 "x,y,z,yaw,pitch in metres and degrees; yaw 0 looks along -z and grows to the left")
      ->envname("SCREE_CAMERA");
  app.add_option("--method", texts.method, "How it is drawn:\n" + describe_methods())
      ->envname("SCREE_METHOD");
  app.add_option("--view-radius", options.view_radius_m, "How far terrain is drawn, metres")
      ->envname("SCREE_VIEW_RADIUS")
      ->check(CLI::Range(limits::view_radius_min_m, limits::view_radius_max_m));
  app.add_flag("--offscreen", options.offscreen, "No window: take the screenshots, then exit")
      ->envname("SCREE_OFFSCREEN");
  app.add_option(
         "--screenshot", texts.screenshots,
         "FILE[@WHEN], a PNG; repeatable. WHEN: joined (default), pieces>=N (that many pieces are in sight), "
         "settled (something was carved, and all pieces are terrain again)")
      ->envname("SCREE_SCREENSHOT");
  app.add_option("--timeout", options.timeout_s, "Offscreen: seconds after which to give up")
      ->envname("SCREE_TIMEOUT")
      ->check(CLI::PositiveNumber);
  app.add_flag("--gl-debug", options.gl_debug, "Ask for a debug context, and fail on any OpenGL error")
      ->envname("SCREE_GL_DEBUG");
  app.footer(
      "Keys: W A S D move, Space and C up and down, Shift faster, mouse looks, left click carves, the wheel "
      "sets\n"
      "the radius, M draws by the next method, Tab frees the mouse, H help, Esc ends.");
}

Result<void> understand(const Texts& texts, ViewerOptions& options) {
  if (Result<void> size = parse_size(texts.size, options); !size) return size;
  if (Result<void> camera = parse_camera(texts.camera, options.camera); !camera) return camera;
  options.method = method_named(texts.method);
  if (options.method == nullptr)
    return fail("--method: there is no '" + texts.method + "'; there are\n" + describe_methods());
  for (const std::string& text : texts.screenshots) {
    Result<ScreenshotOrder> order = parse_screenshot(text);
    if (!order) return fail(order.error().message);
    options.screenshots.push_back(std::move(*order));
  }
  if (options.offscreen && options.screenshots.empty())
    return fail("--offscreen without --screenshot FILE shows nothing to anyone");
  return {};
}

}  // namespace

std::variant<ViewerOptions, ExitNow> parse_options(int argc, const char* const* argv) {
  ViewerOptions options;
  options.port = default_port;
  options.view_radius_m = 96.0F;
  options.timeout_s = 120.0;
  Texts texts;
  CLI::App app("Looks at a Scree server's terrain, live or replayed, and carves it.", "scree-viewer");
  app.option_defaults()->always_capture_default();
  declare(app, options, texts);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return ExitNow{app.exit(error) == 0 ? 0 : 2};
  }
  if (const Result<void> understood = understand(texts, options); !understood) {
    std::fprintf(stderr, "scree-viewer: %s\n", understood.error().message.c_str());
    return ExitNow{2};
  }
  return options;
}

}  // namespace scree
