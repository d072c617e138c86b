#include "client/web/page_client.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <emscripten/em_js.h>
#include <emscripten/html5.h>
#include <glm/trigonometric.hpp>

#include "client/web/limits.h"
#include "shared/base/timing.h"

// clang-format off
/// Calls the page's reader (page/glb.js). What it returns is of malloc(), and begins with two counts. Null: it
/// could not read the bytes, and has said so.
EM_JS(uint32_t*, scree_read_model, (const uint8_t* bytes, size_t size), {
  const mesh = Module["readModel"] && Module["readModel"](HEAPU8.slice(bytes, bytes + size));
  const place = mesh ? _malloc(mesh.length) : 0;
  if (place) HEAPU8.set(mesh, place);
  return place;
});
// clang-format on

namespace scree {
namespace {

Result<ModelMesh> read_page_model(std::span<const uint8_t> bytes) {
  uint32_t* const read = scree_read_model(bytes.data(), bytes.size());
  if (read == nullptr) return fail("");
  std::vector<ModelVertex> vertices(read[0]);
  std::vector<uint32_t> corners(read[1]);
  std::memcpy(vertices.data(), read + 2, vertices.size() * sizeof(ModelVertex));
  std::memcpy(corners.data(), read + 2 + vertices.size() * sizeof(ModelVertex) / sizeof(uint32_t),
              corners.size() * sizeof(uint32_t));
  std::free(read);
  return checked_model(std::move(vertices), std::move(corners));
}

SessionChoice session_choice() {
  SessionChoice choice;
  choice.interest_radius_m = Visit::interest_radius_m({}, AutoQuality::first);
  choice.program = "scree-web";
  choice.cache.bytes_max = limits::page_cache_bytes;
  choice.cache.models = true;
  choice.apply_s = limits::page_apply_s;
  return choice;
}

}  // namespace

Result<std::unique_ptr<PageClient>> PageClient::begin(PageSocket& socket) {
  Result<std::unique_ptr<View>> view = View::create(
      all_methods().front(), traits_of(AutoQuality::first).view_radius_m, nullptr, read_page_model);
  if (!view) return fail(view.error().message);
  return std::unique_ptr<PageClient>(
      new PageClient(std::move(*view), std::make_unique<SocketConnector>(socket, "this server")));
}

PageClient::PageClient(std::unique_ptr<View> view, std::unique_ptr<SocketConnector> connector)
    : connector_(connector.get()),
      visit_(std::move(connector), session_choice(), VisitChoice{}, std::move(view)) {
  visit_.view->renderer().ask_for_errors_each_time(false);
}

void PageClient::resize(int width, int height) {
  width_ = width;
  height_ = height;
}

float PageClient::aspect() const {
  return height_ > 0 ? static_cast<float>(width_) / static_cast<float>(height_) : 1.0F;
}

void PageClient::act(Action action, double now_s) {
  const ToolHolder holder = visit_.session.holder();
  change(tool, action, holder.palette, holder.carried);
  change(hand, action);
  visit_.session.timeline().act(action);
  switch (action) {
    case Action::walk:
      return whereabouts_.walk_or_fly(visit_.camera, visit_.session, now_s);
    case Action::give_away:
      return visit_.session.give_away(now_s);
    case Action::next_eye:
      static_cast<void>(whereabouts_.follow_next_eye(visit_.session, now_s));
      return;
    case Action::replay_play:
      if (!visit_.session.is_replay()) asked_.push_back(action);
      return;
    case Action::next_method:
      // It is one that this context can draw.
      static_cast<void>(choose_method(next_available(visit_.view->methods().chosen())));
      return;
    case Action::overlay:
      overlay.shown = !overlay.shown;
      return;
    case Action::picture:
    case Action::copy_place:
    case Action::talk:
    case Action::mute:
    case Action::persons:
    case Action::figures:
    case Action::all_figures:
    case Action::graphs:
    case Action::panel:
    case Action::help:
    case Action::hide:
    case Action::full_screen:
    case Action::free_mouse:
    case Action::smaller_text:
    case Action::larger_text:
    case Action::present:
      asked_.push_back(action);
      return;
    default:  // done above, or not here
      return;
  }
}

/// At the aim of each: what the one before has taken is gone.
void PageClient::strike(const PageIntents& intents, double now_s) {
  const int times = strike_.step(intents.strikes, intents.strike_held, traits_of(tool.use).repeat_s, now_s);
  if (visit_.session.is_replay()) return;
  if (times > 0 && visit_.aim()) hints_.note(tool.use);
  for (int i = 0; i < times; ++i)
    visit_.session.strike(tool, visit_.camera.eye_m, visit_.camera.forward(), now_s);
}

std::string_view PageClient::hint(double now_s) {
  return hints_.text(!visit_.session.holder().carried.empty(), has_past, now_s);
}

Result<void> PageClient::frame() {
  const double now_s = steady_now_s();
  const double elapsed_s = last_s_ ? now_s - *last_s_ : 0.0;
  last_s_ = now_s;
  const float moved_s = std::min(static_cast<float>(elapsed_s), limits::page_elapsed_max_s);
  PageIntents intents = input.drain(moved_s);
  intents.fly.turn *= hand.mouse_speed;
  // In a replay, these keys move the moment.
  if (!visit_.session.is_replay()) intents.fly.turn += turn_by_keys(intents.turn_keys, moved_s);
  visit_.camera.field_of_view = glm::radians(hand.field_of_view_degrees);
  whereabouts_.step(visit_.camera, intents.fly, moved_s, visit_.session, now_s);
  for (const Action action : intents.actions) act(action, now_s);
  grow(tool, intents.wheel);
  strike(intents, now_s);
  visit_.show_particles(particles);
  visit_.show_details(details);
  visit_.shake(shake);
  visit_.session.predict(predicts);
  Stopwatch stopwatch;
  if (stepped_) stepped_ = visit_.step(now_s);
  if (!stepped_) return stepped_;
  const double update_ms = stopwatch.lap_ms();
  if (width_ > 0 && height_ > 0)
    visit_.view->renderer().draw(visit_.view->methods().shown(), visit_.shaken_camera(now_s), 0, width_,
                                 height_, visit_.lines(tool, overlay, whereabouts_.eye().person(), now_s));
  note(elapsed_s * 1000.0, update_ms, stopwatch.lap_ms());
  if (visit_.view->work_for(0.0)) work_later();
  if (visit_.session.timeline().is_known() && visit_.session.timeline().marks() != marks_) {
    marks_ = visit_.session.timeline().marks();
    ++marks_told_;
  }
  return {};
}

void PageClient::work_later() {
  if (std::exchange(works_, true)) return;
  emscripten_set_timeout([](void* client) { static_cast<PageClient*>(client)->work(); }, 0.0, this);
}

/// Between frames, as long as there is work, for a browser that draws slowly has time for it: also to begin
/// what comes next, while the world is not there yet.
void PageClient::work() {
  works_ = false;
  const bool loaded = visit_.view->methods().loaded();
  if (!loaded && stepped_) stepped_ = visit_.step(steady_now_s());
  if (visit_.view->work_for(loaded ? limits::page_work_s : limits::page_load_s)) work_later();
}

void PageClient::note(double elapsed_ms, double update_ms, double draw_ms) {
  if (elapsed_ms > 0.0) frames_ms_.push_back(static_cast<float>(elapsed_ms));
  if (frames_ms_.size() > limits::page_frames_max) frames_ms_.pop_front();
  times_.last = elapsed_ms;
  times_.update = update_ms;
  times_.draw = draw_ms;
  static_cast<void>(visit_.choose_quality(quality, static_cast<float>(elapsed_ms)));
}

FrameTimes PageClient::frame_times() const {
  FrameTimes times = times_;
  if (frames_ms_.empty()) return times;
  std::vector<float> sorted(frames_ms_.begin(), frames_ms_.end());
  std::ranges::sort(sorted);
  times.median = static_cast<double>(sorted[sorted.size() / 2]);
  times.worst = static_cast<double>(sorted.back());
  return times;
}

HudFacts PageClient::facts() {
  return facts_.find(visit_, steady_now_s());
}

}  // namespace scree
