#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "client/viewer/app.h"
#include "client/viewer/pictures/egl_context.h"
#include "client/viewer/viewing/flight.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

/// Pause between two steps of the session: far below a tick.
constexpr std::chrono::milliseconds pause{2};
constexpr int differs_status = 3;

Result<void> make_folder(const std::string& folder) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) return fail("--frames: " + folder + " cannot be made: " + error.message());
  return {};
}

std::string timeout_message(const Viewing& viewing, bool flying) {
  std::string message = "gave up after ";
  message += std::to_string(static_cast<int>(viewing.options.timeout_s));
  message += " s (--timeout) without";
  for (const ScreenshotOrder& order : viewing.screenshots.waiting())
    message.append(" ").append(order.description());
  if (flying) message += " the next frame of the path";
  message += viewing.session.connected() ? "; connected to " : "; ";
  message += viewing.session.description();
  return message;
}

/// First the screenshots from where the camera stands, then the path.
Result<void> draw_all(Viewing& viewing, std::optional<Flight>& flight) {
  const ViewerOptions& options = viewing.options;
  double progress_s = steady_now_s();
  bool flying = false;
  const auto done = [&] { return viewing.screenshots.empty() && (!flight || flight->over(options)); };
  while (!done()) {
    const double now_s = steady_now_s();
    if (now_s > progress_s + options.timeout_s) return fail(timeout_message(viewing, flying));
    if (flying) {
      const Result<bool> drawn = flight->turn(viewing, now_s);
      if (!drawn) return fail(drawn.error().message);
      if (*drawn) progress_s = now_s;
      if (*drawn && options.time_demo) continue;
    } else {
      const size_t waiting = viewing.screenshots.waiting().size();
      TRY(viewing.step(now_s));
      if (viewing.session.gave_up()) return fail(viewing.session.description());
      TRY(viewing.shoot_due(now_s));
      flying = flight && viewing.screenshots.empty() && viewing.joined(now_s);
      if (flying || waiting != viewing.screenshots.waiting().size()) progress_s = now_s;
    }
    std::this_thread::sleep_for(pause);
  }
  return {};
}

Result<int> run(const ViewerOptions& options) {
  const Result<std::unique_ptr<EglContext>> context = EglContext::create(options.gl_debug);
  if (!context) return fail(context.error().message);
  const Result<std::unique_ptr<Viewing>> viewing = Viewing::begin(options);
  if (!viewing) return fail(viewing.error().message);
  if (Result<void> folder = make_folder(options.frames); !folder) return fail(folder.error().message);
  std::optional<Flight> flight;
  if (options.path) flight.emplace(*options.path);
  if (Result<void> drawn = draw_all(**viewing, flight); !drawn) return fail(drawn.error().message);
  if (Result<void> finished = (*viewing)->finish(); !finished) return fail(finished.error().message);
  if (!options.frames.empty())
    std::fprintf(stderr, "wrote %zu frames to %s\n", flight->frames(), options.frames.c_str());
  if (options.time_demo) std::printf("%s\n", flight->times(**viewing).c_str());
  const std::optional<double>& difference = (*viewing)->difference;
  if (!difference) return 0;
  const bool agrees = *difference <= options.threshold;
  const nlohmann::ordered_json json{
      {"difference", *difference}, {"threshold", options.threshold}, {"agrees", agrees}};
  std::printf("%s\n", json.dump().c_str());
  return agrees ? 0 : differs_status;
}

}  // namespace

int run_offscreen(const ViewerOptions& options) {
  const Result<int> status = run(options);
  if (!status) std::fprintf(stderr, "scree-viewer: %s\n", status.error().message.c_str());
  return status ? *status : 1;
}

}  // namespace scree
