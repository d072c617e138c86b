#include <algorithm>
#include <cmath>
#include <cstdio>

#include "client/viewer/app.h"
#include "client/viewer/app_window.h"
#include "client/viewer/fly_camera.h"
#include "client/viewer/hud.h"
#include "client/viewer/viewing.h"

namespace scree {
namespace {

constexpr float radius_start_m = 2.0F;
constexpr float radius_min_m = 0.5F;
constexpr float radius_max_m = 4.0F;
constexpr float radius_step = 1.12F;  ///< factor a notch of the wheel

HudFacts facts_of(Viewing& viewing, float radius_m, double now_s) {
  HudFacts facts;
  Session& session = viewing.session;
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
  if (DrawMethod* method = viewing.view->methods().shown()) {
    facts.method = method->name();
    facts.draw = method->stats();
    facts.gpu_times = viewing.view->renderer().gpu_times();
  }
  return facts;
}

/// Flies along the path by the clock, once the world is there; afterwards the person has the camera.
void follow_path(Viewing& viewing, std::optional<double>& begun_s, double now_s) {
  if (!begun_s && viewing.joined(now_s)) begun_s = now_s;
  const double flown_s = begun_s ? now_s - *begun_s : 0.0;
  if (flown_s <= viewing.options.path->duration_s()) viewing.camera = viewing.options.path->at(flown_s);
}

/// One frame of the window: from the person's input to the picture.
Result<void> run_frame(AppWindow& window, Viewing& viewing, Hud& hud, std::optional<double>& path_begun_s,
                       float& radius_m) {
  const AppInput input = window.poll();
  const double now_s = steady_now_s();
  fly(viewing.camera, input.fly, input.elapsed_s);
  if (viewing.options.path) follow_path(viewing, path_begun_s, now_s);
  radius_m = std::clamp(radius_m * std::pow(radius_step, input.wheel), radius_min_m, radius_max_m);
  if (input.toggle_help) hud.toggle_help();
  MethodSwitch& methods = viewing.view->methods();
  if (input.next_method)
    if (Result<void> chosen = methods.choose(next_available(methods.chosen())); !chosen) return chosen;
  if (input.click) viewing.session.carve(viewing.camera.eye_m, viewing.camera.forward(), radius_m);
  if (Result<void> stepped = viewing.step(now_s); !stepped) return stepped;
  viewing.view->renderer().draw(methods.shown(), viewing.camera, 0, window.width(), window.height());
  hud.draw(facts_of(viewing, radius_m, now_s), input.elapsed_s * 1000.0F);
  window.show_frame();
  return viewing.take_due(now_s);
}

Result<void> run(const ViewerOptions& options) {
  const Result<std::unique_ptr<AppWindow>> window =
      AppWindow::open(options.width, options.height, options.gl_debug);
  if (!window) return fail(window.error().message);
  const Result<std::unique_ptr<Viewing>> viewing = Viewing::begin(options);
  if (!viewing) return fail(viewing.error().message);
  Hud hud(**window);
  std::optional<double> path_begun_s;
  float radius_m = radius_start_m;
  while (!(*window)->should_close())
    if (Result<void> done = run_frame(**window, **viewing, hud, path_begun_s, radius_m); !done) return done;
  return (*viewing)->finish();
}

}  // namespace

int run_window(const ViewerOptions& options) {
  const Result<void> done = run(options);
  if (!done) std::fprintf(stderr, "scree-viewer: %s\n", done.error().message.c_str());
  return done ? 0 : 1;
}

}  // namespace scree
