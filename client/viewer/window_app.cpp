#include "client/viewer/window_app.h"

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <tuple>
#include <utility>

#include "client/viewer/app.h"
#include "client/viewer/base/camera_text.h"
#include "client/viewer/base/files.h"
#include "client/viewer/pictures/png.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

constexpr double said_s = 6.0;

/// "scree-2026-11-22-203015.png", with a number before the ending if there is such a file.
std::string new_file(const char* what, const char* ending) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[64];
  std::strftime(text, sizeof text, "%Y-%m-%d-%H%M%S", &local);
  const std::string stem = std::string(what) + "-" + text;
  std::string file = stem + ending;
  for (int i = 2; std::filesystem::exists(file); ++i) file = stem + "-" + std::to_string(i) + ending;
  return file;
}

}  // namespace

WindowApp::WindowApp(AppWindow& window, Viewing& viewing, const Settings& loaded, const Hints& hints,
                     bool rewinds)
    : window_(window),
      viewing_(viewing),
      screen_(window),
      choice_(loaded.hud),
      hand_(loaded.hand),
      overlay_(loaded.overlay),
      tool_(loaded.tool),
      hints_(hints),
      rewinds_(rewinds),
      method_options_(viewing.options.method_options),
      particles_(viewing.options.particles),
      details_(viewing.options.details),
      shake_(viewing.options.shake),
      predict_(viewing.options.predict),
      sound_(viewing.options.sound),
      quality_(viewing.options.quality) {
  overlay_.shown = overlay_.shown || viewing.options.overlay.shown;
  tool_.pattern = viewing.options.pattern.value_or(tool_.pattern);
}

/// Flies along the path by the clock, once the world is loaded; then the person moves the camera.
void WindowApp::follow_path(double now_s) {
  if (!path_begun_s_ && viewing_.joined(now_s)) path_begun_s_ = now_s;
  const double flown_s = path_begun_s_ ? now_s - *path_begun_s_ : 0.0;
  const CameraPath& path = *viewing_.options.path;
  if (flown_s <= path.duration_s()) viewing_.camera = path.at(flown_s);
}

void WindowApp::choose_quality(float frame_ms, double now_s) {
  if (const std::optional<Quality> other = viewing_.choose_quality(quality_, frame_ms))
    say("quality: " + std::string(name_of(*other)) + ", chosen by the time of a frame; the panel has others",
        now_s);
}

Result<void> WindowApp::choose(const MethodEntry& method) {
  return viewing_.view->methods().choose(method);
}

void WindowApp::say(const std::string& text, double now_s) {
  said_ = text;
  said_until_s_ = now_s + said_s;
}

/// Flips what the action shows or hides.
void WindowApp::act_on_view(Action action) {
  const auto flip = [&](Action one, bool& shown) {
    if (action == one) shown = !shown;
  };
  if (action == Action::help) choice_.help = after(choice_.help);
  flip(Action::overlay, overlay_.shown);
  flip(Action::figures, choice_.figures);
  flip(Action::all_figures, choice_.all_figures);
  flip(Action::graphs, choice_.graphs);
  flip(Action::panel, choice_.panel);
  flip(Action::persons, choice_.persons);
  flip(Action::hide, hidden_);
}

void WindowApp::mute_or_play(double now_s) {
  sound_ = !sound_;
  viewing_.play_sound(sound_);
  say(sound_ ? "sound on" : "sound off; 6: on", now_s);
}

/// What cannot be written is said, and nothing else: the world goes on.
Result<void> WindowApp::act_on_files(Action action, double now_s) {
  if (action == Action::copy_place) {
    const std::string option = "--camera " + camera_text(viewing_.camera);
    window_.copy(option);
    say("copied: " + option, now_s);
  }
  if (action == Action::picture && viewing_.view->methods().shown() != nullptr) {
    const Result<Image> image = viewing_.picture(now_s, window_.width(), window_.height());
    if (!image) return fail(image.error().message);
    const std::string file = new_file("scree", ".png");
    const Result<void> written = write_png(file, *image);
    say(written ? "wrote " + file : written.error().message, now_s);
  }
  if (action == Action::record_path) {
    if (recorder_) {
      end_path(now_s);
    } else {
      recorder_.emplace().add(now_s, viewing_.camera);
    }
  }
  return {};
}

void WindowApp::record_path(double now_s) {
  if (recorder_ && !recorder_->add(now_s, viewing_.camera)) end_path(now_s);
}

void WindowApp::end_path(double now_s) {
  const std::string file = new_file("scree-path", ".json");
  const Result<void> written = write_text(file, recorder_->text());
  say(written ? "wrote " + file + ": the viewer's --path " + file + " flies it" : written.error().message,
      now_s);
  recorder_.reset();
}

/// Says what changed, but for what the tool line shows.
void WindowApp::change_hand(Action action, double now_s) {
  if (!viewing_.session.is_replay()) {
    const ToolHolder holder = viewing_.session.holder();
    Tool shown = tool_;
    change(tool_, action, holder.palette, holder.carried);
    std::tie(shown.use, shown.kind, shown.radius_m) = std::tie(tool_.use, tool_.kind, tool_.radius_m);
    if (shown != tool_) say(describe(tool_), now_s);
  }
  const HandChoice hand = hand_;
  change(hand_, action);
  if (hand != hand_) say(describe(hand_, action), now_s);
}

Result<void> WindowApp::act(const AppInput& input, double now_s) {
  const MethodSwitch& methods = viewing_.view->methods();
  for (const Action action : input.actions) {
    change_hand(action, now_s);
    act_on_view(action);
    if (action == Action::mute) mute_or_play(now_s);
    act_on_session(action, now_s);
    TRY(act_on_files(action, now_s));
    if (action != Action::next_method) continue;
    const MethodEntry& next = next_available(methods.chosen());
    say(std::string(next.name) + ": " + std::string(next.summary), now_s);
    TRY(choose(next));
  }
  if (input.said) viewing_.session.say(*input.said);
  grow(tool_, input.wheel);
  strike(input, now_s);
  return {};
}

void WindowApp::act_on_session(Action action, double now_s) {
  ViewerSession& session = viewing_.session;
  session.timeline().act(action);
  if (action == Action::next_eye && !whereabouts_.follow_next_eye(session, now_s))
    say("nobody else is here, so there is no other view", now_s);
  if (action == Action::walk) {
    whereabouts_.walk_or_fly(viewing_.camera, session, now_s);
    say(flies() ? "you fly; Q: walk" : "you walk, and Space jumps; Q: fly", now_s);
  }
  if (action == Action::give_away && !session.is_replay()) session.give_away(now_s);
  if (viewing_.options.past_port && action == (session.is_replay() ? Action::present : Action::replay_play))
    leaves_ = true;
  // The window passes it on where nothing can be written.
  if (action == Action::talk && session.next_try_s(now_s)) session.try_now();
}

/// Once the replay has said where it stands.
void WindowApp::rewind() {
  Timeline& timeline = viewing_.session.timeline();
  if (!rewinds_ || !timeline.is_known()) return;
  rewinds_ = false;
  timeline.act(Action::replay_end);
  timeline.ask({.play = ReplayPlay::play, .speed = -1.0F});
}

/// At the aim of each: what the one before has taken is gone.
void WindowApp::strike(const AppInput& input, double now_s) {
  const int times = strike_.step(input.strikes, input.strike_held, traits_of(tool_.use).repeat_s, now_s);
  if (times > 0 && !viewing_.session.is_replay() && viewing_.aim()) hints_.note(tool_.use);
  for (int i = 0; i < times; ++i)
    viewing_.session.strike(tool_, viewing_.camera.eye_m, viewing_.camera.forward(), now_s);
}

void WindowApp::choose(MenuChoice choice) {
  if (choice == MenuChoice::none) return;
  window_.close_menu();
  if (choice == MenuChoice::tell_keys) choice_.help = Telling::all;
  if (choice == MenuChoice::end) window_.end();
}

/// The last ones are those that are shown in any case.
std::vector<std::string> WindowApp::messages(double now_s) {
  std::vector<std::string> lines = viewing_.session.conversation().lines(now_s, window_.writes().has_value());
  MethodSwitch& methods = viewing_.view->methods();
  if (const DrawMethod* shown = methods.shown();
      shown != nullptr && shown->reach_m() < viewing_.view_radius_m())
    lines.push_back(std::string(methods.shown_name()) + " draws " +
                    std::to_string(static_cast<int>(shown->reach_m())) +
                    " m far, because its cells end there; the panel has more cells, and larger ones");
  if (eye().follows()) lines.push_back(eye().description(viewing_.session.figures(now_s)));
  if (recorder_) lines.emplace_back("recording the camera's path; K ends it");
  if (now_s < said_until_s_)
    lines.push_back(said_);
  else if (std::string advice = hint(now_s); !advice.empty())
    lines.push_back(std::move(advice));
  if (const auto& line = window_.writes()) lines.push_back("say: " + line->text() + "_");
  return lines;
}

/// The one line that helps now; empty: none does.
std::string WindowApp::hint(double now_s) {
  const ViewerSession& session = viewing_.session;
  if (!session.connected() || choice_.help != Telling::nothing) return {};
  if (session.is_replay() && viewing_.options.past_port)
    return "J holds or plays, Y turns time round, Left and Right jump; Backspace: back to the present";
  if (session.is_replay())
    return window_.holds_mouse() ? "" : "click, and the mouse looks around; J plays, or holds; H: all keys";
  if (!hints_.has_begun())
    return window_.holds_mouse() ? "click, or press E, to dig where the cross is; hold it to dig on"
                                 : "click, and the mouse looks around, or use the arrow keys; E digs where "
                                   "the cross is; H: all keys";
  return std::string(
      hints_.text(!session.holder().carried.empty(), viewing_.options.past_port.has_value(), now_s));
}

Result<void> WindowApp::draw_hud(const FrameParts& parts, double now_s) {
  const HudFacts facts = facts_.find(viewing_, now_s);
  screen_.begin(!window_.holds_mouse(), hud_.text_px(hand_.text_scale));
  hud_.begin(!window_.holds_mouse());
  hud_.note(facts, parts);
  const MethodEntry* picked = nullptr;
  if (!hidden_) {
    hud_.crosshair(facts);
    const float aspect = static_cast<float>(window_.width()) / static_cast<float>(window_.height());
    const Camera& camera = viewing_.camera;
    hud_.signs(viewing_.signs(aspect, now_s));
    hud_.names(viewing_.session.figures(now_s),
               camera.projection(aspect, viewing_.view_radius_m()) * camera.view(), eye().person());
    if (choice_.figures || choice_.all_figures) hud_.figures(facts, choice_.all_figures);
    hud_.lower_right(facts, choice_.persons ? &viewing_.session.conversation().persons() : nullptr,
                     viewing_.session.colours(), choice_.graphs);
    if (choice_.panel)
      picked = hud_.panel(viewing_.view->methods().chosen(),
                          {tool_, viewing_.session.palette(), overlay_, method_options_, particles_, details_,
                           shake_, predict_, hand_, quality_},
                          {facts.is_replay, choice_.all_figures});
    hud_.help(choice_.help, window_.has_gamepad(),
              viewing_.session.is_replay() ? ControlsOf::replay : ControlsOf::live);
    if (facts.is_replay)
      hud_.timeline(viewing_.session.timeline(), now_s);
    else if (viewing_.session.mirror() != nullptr)
      hud_.tool_line(tool_, viewing_.aim(), facts, viewing_.session.palette());
    if (facts.lost && hud_.lost(facts)) viewing_.session.try_now();
    hud_.messages(facts, messages(now_s));
  }
  if (MenuKeys* menu = window_.menu())
    choose(hud_.menu(*menu, words_before_the_end(!facts.carried.empty(), !viewing_.options.token.empty())));
  screen_.end();
  viewing_.show_particles(particles_);
  viewing_.show_details(details_);
  viewing_.shake(shake_);
  viewing_.session.predict(predict_);
  viewing_.view->methods().set_options(method_options_);
  return picked == nullptr ? Result<void>() : choose(*picked);
}

Result<void> WindowApp::frame() {
  AppInput input = window_.poll();
  const double now_s = steady_now_s();
  input.fly.turn *= hand_.mouse_speed;
  // In a replay, these keys move the moment.
  if (!viewing_.session.is_replay()) input.fly.turn += turn_by_keys(input.turn_keys, input.elapsed_s);
  window_.let_write(viewing_.session.connected());
  viewing_.camera.field_of_view = glm::radians(hand_.field_of_view_degrees);
  whereabouts_.step(viewing_.camera, input.fly, input.elapsed_s, viewing_.session, now_s);
  if (viewing_.options.path) follow_path(now_s);
  record_path(now_s);
  TRY(act(input, now_s));
  rewind();
  FrameParts parts{input.elapsed_s * 1000.0F, 0.0F, 0.0F};
  Stopwatch stopwatch;
  TRY(viewing_.step(now_s));
  parts.update_ms = static_cast<float>(stopwatch.lap_ms());
  if (!window_.minimised()) {
    View& view = *viewing_.view;
    view.renderer().draw(view.methods().shown(), viewing_.shaken_camera(now_s), 0, window_.width(),
                         window_.height(), viewing_.lines(tool_, overlay_, eye().person(), now_s, !hidden_));
    parts.draw_ms = static_cast<float>(stopwatch.lap_ms());
    TRY(draw_hud(parts, now_s));
  }
  window_.show_frame();
  if (!window_.minimised()) choose_quality(parts.frame_ms, now_s);
  return viewing_.shoot_due(now_s);
}

Settings WindowApp::settings() const {
  Settings settings;
  std::tie(settings.width, settings.height) = window_.window_size();
  settings.method = viewing_.view->methods().chosen().name;
  settings.quality = quality_;
  settings.method_options = method_options_;
  settings.hud = choice_;
  settings.hand = hand_;
  settings.overlay = overlay_;
  settings.tool = tool_;
  settings.particles = particles_;
  settings.details = details_;
  settings.shake = shake_;
  settings.predict = predict_;
  settings.sound = sound_;
  return settings;
}

namespace {

/// What stays with a person who goes from the present to the past and back.
struct Person {
  Settings settings;
  std::optional<Settings> start;  ///< of the first app
  Hints hints;
};

/// Shows the place until the person closes the window or leaves; true: leaves. `other`: the place that goes
/// on meanwhile, so that its server keeps the session; null: none.
Result<bool> stay(AppWindow& window, Viewing& viewing, Visit* other, Person& person) {
  WindowApp app(window, viewing, person.settings, person.hints, other != nullptr);
  if (!person.start) person.start = app.settings();
  while (!window.should_close() && !app.leaves()) {
    TRY(app.frame());
    if (other != nullptr) TRY(other->step(steady_now_s()));
  }
  person.settings = app.settings();
  person.hints = app.hints();
  return app.leaves();
}

/// The replay, seen from where the person is.
ViewerOptions past_of(ViewerOptions options, const Camera& camera) {
  std::swap(options.port, *options.past_port);
  options.camera = camera;
  options.given.camera = true;
  options.screenshots.clear();
  options.sound_file.clear();
  options.trace_file.clear();
  return options;
}

Result<void> run(ViewerOptions options) {
  const SettingsFile saved(settings_file());
  apply_settings(saved.loaded(), options);
  const Result<std::unique_ptr<AppWindow>> window =
      AppWindow::open(options.width, options.height, options.gl_debug);
  if (!window) return fail(window.error().message);
  // The driver may lack a feature that an earlier run's driver had.
  if (!options.given.method && options.method->missing()) options.method = &all_methods().front();
  const Result<std::unique_ptr<Viewing>> present = Viewing::begin(options);
  if (!present) return fail(present.error().message);
  Person person{saved.loaded(), {}, {}};
  while (TRY(stay(**window, **present, nullptr, person))) {
    const ViewerOptions there = past_of(options, (*present)->camera);
    const Result<std::unique_ptr<Viewing>> past = Viewing::begin(there);
    if (!past) return fail(past.error().message);
    TRY(stay(**window, **past, present->get(), person));
    (*present)->place_camera((*past)->camera);
  }
  saved.save(*person.start, person.settings);
  return (*present)->finish();
}

}  // namespace

int run_window(const ViewerOptions& options) {
  const Result<void> done = run(options);
  if (!done) std::fprintf(stderr, "scree-viewer: %s\n", done.error().message.c_str());
  return done ? 0 : 1;
}

}  // namespace scree
