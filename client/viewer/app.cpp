#include "client/viewer/app.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "client/viewer/app_window.h"
#include "client/viewer/egl_context.h"
#include "client/viewer/fly_camera.h"
#include "client/viewer/hud.h"
#include "client/viewer/limits.h"
#include "client/viewer/png.h"
#include "client/viewer/sight.h"
#include "client/viewer/view.h"

namespace scree {
namespace {

constexpr float radius_start_m = 2.0F;
constexpr float radius_min_m = 0.5F;
constexpr float radius_max_m = 4.0F;
constexpr float radius_step = 1.12F;  ///< factor a notch of the wheel
/// Offscreen, between two looks at the session: far below a tick.
constexpr std::chrono::milliseconds offscreen_pause{2};

int complain(const std::string& message) {
  std::fprintf(stderr, "scree-viewer: %s\n", message.c_str());
  return 1;
}

HudFacts facts_of(Session& session, View& view, float radius_m, double now_s) {
  HudFacts facts;
  facts.connection = session.description();
  facts.lost = !session.connected();
  facts.bytes_per_s = session.received_bytes_per_s();
  facts.carve_radius_m = radius_m;
  facts.notice = session.notice(now_s);
  if (const Mirror* mirror = session.mirror()) {
    facts.tick = mirror->tick();
    facts.pieces = mirror->pieces().size();
    facts.status = mirror->status();
    facts.mismatches = mirror->mismatches();
  }
  if (DrawMethod* method = view.methods().shown()) {
    facts.method = method->name();
    facts.draw = method->stats();
  }
  return facts;
}

Moment moment_of(Session& session, View& view, const ViewerOptions& options, const Camera& camera,
                 double now_s) {
  Moment moment;
  moment.now_s = now_s;
  moment.current = view.methods().complete();
  moment.joined = view.methods().loaded() && session.joined(now_s);
  moment.carved = session.carved();
  if (Mirror* mirror = session.mirror()) {
    const Scene scene{mirror->field(), session.pieces(now_s)};
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    moment.pieces = pieces_in_sight(scene, camera, aspect, options.view_radius_m);
    const bool elsewhere = mirror->status() && mirror->status()->pieces > 0;
    moment.alive = !mirror->pieces().empty() || elsewhere;
  }
  return moment;
}

Result<void> take(const ScreenshotOrder& order, View& view, const ViewerOptions& options,
                  const Camera& camera) {
  const Result<Image> image =
      view.renderer().draw_image(*view.methods().shown(), camera, options.width, options.height);
  if (!image) return fail(image.error().message);
  if (Result<void> written = write_png(order.file, *image); !written) return written;
  std::printf("wrote %s\n", order.description().c_str());
  std::fflush(stdout);
  return {};
}

Result<void> take_due(ScreenshotQueue& queue, Session& session, View& view, const ViewerOptions& options,
                      const Camera& camera, double now_s) {
  if (queue.empty()) return {};
  for (const ScreenshotOrder& order : queue.take_due(moment_of(session, view, options, camera, now_s)))
    if (Result<void> taken = take(order, view, options, camera); !taken) return taken;
  return {};
}

Result<void> check_gl_errors(View& view, const ViewerOptions& options) {
  if (!options.gl_debug || view.renderer().gl_errors() == 0) return {};
  return fail(std::to_string(view.renderer().gl_errors()) +
              " OpenGL errors; the first: " + view.renderer().first_gl_error());
}

std::string timeout_message(const ViewerOptions& options, const ScreenshotQueue& queue,
                            const Session& session) {
  std::string message = "gave up after ";
  message += std::to_string(static_cast<int>(options.timeout_s));
  message += " s (--timeout) without";
  for (const ScreenshotOrder& order : queue.waiting()) message.append(" ").append(order.description());
  message += session.connected() ? "; connected to " : "; ";
  message += session.description();
  return message;
}

/// One frame of the window: from the person's input to the picture.
Result<void> run_frame(AppWindow& window, Session& session, View& view, Hud& hud, Camera& camera,
                       float& radius_m) {
  const AppInput input = window.poll();
  const double now_s = steady_now_s();
  fly(camera, input.fly, input.elapsed_s);
  radius_m = std::clamp(radius_m * std::pow(radius_step, input.wheel), radius_min_m, radius_max_m);
  if (input.toggle_help) hud.toggle_help();
  if (input.next_method) {
    MethodSwitch& methods = view.methods();
    if (Result<void> chosen = methods.choose(next_available(methods.chosen())); !chosen) return chosen;
  }
  if (input.click) session.carve(camera.eye_m, camera.forward(), radius_m);
  const SessionStep step = session.step(now_s, camera.eye_m);
  if (Result<void> followed = view.follow(step, session, camera, now_s); !followed) return followed;
  view.renderer().draw(view.methods().shown(), camera, 0, window.width(), window.height());
  hud.draw(facts_of(session, view, radius_m, now_s), input.elapsed_s * 1000.0F);
  window.show_frame();
  return {};
}

}  // namespace

int run_window(const ViewerOptions& options) {
  const Result<std::unique_ptr<AppWindow>> window =
      AppWindow::open(options.width, options.height, options.gl_debug);
  if (!window) return complain(window.error().message);
  const Result<std::unique_ptr<View>> view = View::create(*options.method, options.view_radius_m);
  if (!view) return complain(view.error().message);
  Hud hud(**window);
  Session session(options.host, options.port, options.view_radius_m);
  ScreenshotQueue queue(options.screenshots);
  Camera camera = options.camera;
  float radius_m = radius_start_m;
  while (!(*window)->should_close()) {
    if (const auto done = run_frame(**window, session, **view, hud, camera, radius_m); !done)
      return complain(done.error().message);
    if (const auto taken = take_due(queue, session, **view, options, camera, steady_now_s()); !taken)
      return complain(taken.error().message);
    if (const auto errors = check_gl_errors(**view, options); !errors)
      return complain(errors.error().message);
  }
  return 0;
}

int run_offscreen(const ViewerOptions& options) {
  const Result<std::unique_ptr<EglContext>> context = EglContext::create(options.gl_debug);
  if (!context) return complain(context.error().message);
  const Result<std::unique_ptr<View>> view = View::create(*options.method, options.view_radius_m);
  if (!view) return complain(view.error().message);
  Session session(options.host, options.port, options.view_radius_m);
  ScreenshotQueue queue(options.screenshots);
  const double give_up_s = steady_now_s() + options.timeout_s;
  while (!queue.empty()) {
    const double now_s = steady_now_s();
    if (now_s > give_up_s) return complain(timeout_message(options, queue, session));
    const SessionStep step = session.step(now_s, options.camera.eye_m);
    if (const auto followed = (*view)->follow(step, session, options.camera, now_s); !followed)
      return complain(followed.error().message);
    if (const auto taken = take_due(queue, session, **view, options, options.camera, now_s); !taken)
      return complain(taken.error().message);
    if (const auto errors = check_gl_errors(**view, options); !errors)
      return complain(errors.error().message);
    std::this_thread::sleep_for(offscreen_pause);
  }
  return 0;
}

}  // namespace scree
