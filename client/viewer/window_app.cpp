#include "client/viewer/window_app.h"

#include <cstdio>
#include <tuple>

#include "client/viewer/app.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

constexpr LineColour preview_colour{255, 236, 170, 150};

}  // namespace

WindowApp::WindowApp(AppWindow& window, Viewing& viewing, const Settings& kept)
    : window_(window),
      viewing_(viewing),
      hud_(window),
      choice_(kept.hud),
      overlay_(kept.overlay),
      tool_(kept.tool),
      grid_(viewing.options.grid),
      predict_(viewing.options.predict) {
  overlay_.shown = overlay_.shown || viewing.options.overlay.shown;
}

/// Flies along the path by the clock, once the world is loaded; then the person moves the camera.
void WindowApp::follow_path(double now_s) {
  if (!path_begun_s_ && viewing_.joined(now_s)) path_begun_s_ = now_s;
  const double flown_s = path_begun_s_ ? now_s - *path_begun_s_ : 0.0;
  const CameraPath& path = *viewing_.options.path;
  if (flown_s <= path.duration_s()) viewing_.camera = path.at(flown_s);
}

Result<void> WindowApp::choose(const MethodEntry& method) {
  return viewing_.view->methods().choose(method);
}

Result<void> WindowApp::act(const AppInput& input, double now_s) {
  const MethodSwitch& methods = viewing_.view->methods();
  for (const Action action : input.actions) {
    change(tool_, action);
    if (action == Action::help) choice_.help = !choice_.help;
    if (action == Action::overlay) overlay_.shown = !overlay_.shown;
    if (action == Action::graphs) choice_.graphs = !choice_.graphs;
    if (action == Action::panel) choice_.panel = !choice_.panel;
    if (action == Action::next_method)
      if (Result<void> chosen = choose(next_available(methods.chosen())); !chosen) return chosen;
  }
  grow(tool_, input.wheel);
  if (input.strike) viewing_.session.strike(tool_, viewing_.camera.eye_m, viewing_.camera.forward(), now_s);
  return {};
}

LineList WindowApp::lines(double now_s) {
  LineList lines;
  const glm::vec3 direction = viewing_.camera.forward();
  if (const auto hit_m = viewing_.session.aim(viewing_.camera.eye_m, direction))
    lines.shape(shape_of(tool_, *hit_m, direction), preview_colour);
  add_cursors(lines, viewing_.session.cursors());
  viewing_.add_overlay(lines, overlay_, now_s);
  return lines;
}

Result<void> WindowApp::draw_hud(const FrameParts& parts, double now_s) {
  const HudFacts facts = facts_.find(viewing_, now_s);
  hud_.begin(!window_.holds_mouse());
  hud_.crosshair();
  hud_.note(facts, parts);
  hud_.figures(facts);
  if (choice_.graphs) hud_.graphs(facts);
  const MethodEntry* picked =
      choice_.panel ? hud_.panel(viewing_.view->methods().chosen(), tool_, overlay_, grid_, predict_)
                    : nullptr;
  viewing_.session.predict(predict_);
  viewing_.view->renderer().set_grid(grid_);
  if (choice_.help) hud_.help();
  const float aspect = static_cast<float>(window_.width()) / static_cast<float>(window_.height());
  const Camera& camera = viewing_.camera;
  hud_.names(viewing_.session.cursors(),
             camera.projection(aspect, viewing_.options.view_radius_m) * camera.view());
  if (facts.lost) hud_.banner(facts.connection);
  hud_.end();
  return picked == nullptr ? Result<void>() : choose(*picked);
}

Result<void> WindowApp::frame() {
  const AppInput input = window_.poll();
  const double now_s = steady_now_s();
  fly(viewing_.camera, input.fly, input.elapsed_s);
  if (viewing_.options.path) follow_path(now_s);
  if (Result<void> acted = act(input, now_s); !acted) return acted;
  FrameParts parts{input.elapsed_s * 1000.0F, 0.0F, 0.0F};
  Stopwatch watch;
  if (Result<void> stepped = viewing_.step(now_s); !stepped) return stepped;
  parts.update_ms = static_cast<float>(watch.lap_ms());
  if (!window_.minimised()) {
    View& view = *viewing_.view;
    view.renderer().draw(view.methods().shown(), viewing_.camera, 0, window_.width(), window_.height(),
                         lines(now_s));
    parts.draw_ms = static_cast<float>(watch.lap_ms());
    if (Result<void> drawn = draw_hud(parts, now_s); !drawn) return drawn;
  }
  window_.show_frame();
  return viewing_.take_due(now_s);
}

Settings WindowApp::settings() const {
  Settings settings;
  std::tie(settings.width, settings.height) = window_.window_size();
  settings.method = viewing_.view->methods().chosen().name;
  settings.view_radius_m = viewing_.options.view_radius_m;
  settings.grid = grid_;
  settings.hud = choice_;
  settings.overlay = overlay_;
  settings.tool = tool_;
  settings.predict = predict_;
  return settings;
}

namespace {

Result<void> run(ViewerOptions options) {
  const KeptSettings kept(settings_file());
  apply_settings(kept.loaded(), options);
  const Result<std::unique_ptr<AppWindow>> window =
      AppWindow::open(options.width, options.height, options.gl_debug);
  if (!window) return fail(window.error().message);
  // The driver may lack a feature that an earlier run's driver had.
  if (!options.given.method && options.method->missing()) options.method = &all_methods().front();
  const Result<std::unique_ptr<Viewing>> viewing = Viewing::begin(options);
  if (!viewing) return fail(viewing.error().message);
  WindowApp app(**window, **viewing, kept.loaded());
  const Settings start = app.settings();
  while (!(*window)->should_close())
    if (Result<void> done = app.frame(); !done) return done;
  kept.keep(start, app.settings());
  return (*viewing)->finish();
}

}  // namespace

int run_window(const ViewerOptions& options) {
  const Result<void> done = run(options);
  if (!done) std::fprintf(stderr, "scree-viewer: %s\n", done.error().message.c_str());
  return done ? 0 : 1;
}

}  // namespace scree
