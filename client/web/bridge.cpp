#include "client/web/bridge.h"

#include <cmath>
#include <deque>
#include <emscripten/html5.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "client/viewer/base/camera_text.h"
#include "client/viewer/synthesis/hearing.h"
#include "client/viewer/synthesis/limits.h"
#include "client/web/page_client.h"
#include "client/web/page_state.h"
#include "client/web/socket_bridge.h"
#include "proto/limits.h"
#include "shared/base/check.h"
#include "shared/material/material_members.h"

namespace scree {
namespace {

/// What the page holds: one client, and the texts and bytes that it may read.
struct Page {
  std::unique_ptr<PageClient> client;
  std::string error;
  std::string camera, asked, catalogue, state, names, signs, marks;
  std::deque<ChannelData> waiting;
  ChannelData heard;
  std::vector<SoundEvent> sounds;
};

Page& page() {
  static Page only;
  return only;
}

PageClient& client() {
  CHECK(page().client != nullptr);
  return *page().client;
}

bool make_context(const char* canvas) {
  EmscriptenWebGLContextAttributes wanted;
  emscripten_webgl_init_context_attributes(&wanted);
  wanted.majorVersion = 2;
  wanted.alpha = EM_FALSE;
  wanted.depth = EM_FALSE;  // pictures are drawn in framebuffers of their own
  wanted.antialias = EM_FALSE;
  wanted.powerPreference = EM_WEBGL_POWER_PREFERENCE_HIGH_PERFORMANCE;
  const EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = emscripten_webgl_create_context(canvas, &wanted);
  return context > 0 && emscripten_webgl_make_context_current(context) == EMSCRIPTEN_RESULT_SUCCESS;
}

/// Sets `value` to the kind of that name, if there is one.
template <HasRows Kind>
int set_kind(Kind& value, const char* name) {
  const std::optional<Kind> kind = kind_named<Kind>(name);
  if (kind) value = *kind;
  return kind ? 1 : 0;
}

bool is_within(float value, float least, float most) {
  return std::isfinite(value) && value >= least && value <= most;
}

int set_number(float& value, float wanted, float least, float most) {
  if (!is_within(wanted, least, most)) return 0;
  value = wanted;
  return 1;
}

}  // namespace
}  // namespace scree

using namespace scree;

// ---- life

int scree_begin(const char* canvas) {
  if (!make_context(canvas)) {
    page().error = "this browser has no WebGL 2, or refuses it";
    return 1;
  }
  Result<std::unique_ptr<PageClient>> made = PageClient::begin(page_socket());
  if (!made) {
    page().error = made.error().message;
    return 2;
  }
  page().client = std::move(*made);
  return 0;
}

const char* scree_error() {
  return page().error.c_str();
}

void scree_leave() {
  page_socket().send(GoodbyeMessage{});
}

// ---- the picture

void scree_resize(int width, int height) {
  if (width < 0 || height < 0 || width > limits::image_side_max || height > limits::image_side_max) return;
  client().resize(width, height);
}

int scree_frame() {
  if (emscripten_is_webgl_context_lost(emscripten_webgl_get_current_context())) {
    page().error = "the browser has lost the WebGL context";
    return 0;
  }
  const Result<void> drawn = client().frame();
  if (!drawn) page().error = drawn.error().message;
  return drawn ? 1 : 0;
}

uint32_t scree_gl_errors() {
  Renderer& renderer = client().visit().view->renderer();
  renderer.ask_for_errors();
  return static_cast<uint32_t>(renderer.gl_errors());
}

// ---- wishes

int scree_set_name(const char* name) {
  const std::string_view given(name);
  if (given.size() > limits::person_name_bytes_max) return 0;
  client().visit().session.set_name(std::string(given));
  return 1;
}

int scree_set_token(const char* token) {
  const std::string_view given(token);
  if (given.size() > limits::access_token_bytes_max) return 0;
  client().set_token(std::string(given));
  return 1;
}

int scree_set_camera(const char* text) {
  Result<Camera> place = parse_camera(text);
  if (!place) return 0;
  client().visit().place_camera(*place);
  return 1;
}

const char* scree_camera() {
  page().camera = camera_text(client().visit().camera);
  return page().camera.c_str();
}

int scree_set_method(const char* name) {
  const MethodEntry* entry = method_named(name);
  return entry != nullptr && client().choose_method(*entry) ? 1 : 0;
}

int scree_set_quality(const char* name) {
  if (std::string_view(name) == "auto") {
    client().quality.reset();
    return 1;
  }
  const std::optional<Quality> quality = kind_named<Quality>(name);
  if (quality) client().quality = quality;
  return quality ? 1 : 0;
}

int scree_set_view_radius(float metres) {
  if (metres != 0.0F && !is_within(metres, limits::view_radius_min_m, limits::view_radius_max_m)) return 0;
  client().visit().set_view_radius(metres == 0.0F ? std::nullopt : std::optional(metres));
  return 1;
}

int scree_set_field_of_view(float degrees) {
  return set_number(client().hand.field_of_view_degrees, degrees, field_of_view_min_degrees,
                    field_of_view_max_degrees);
}

int scree_set_look_speed(float factor) {
  return set_number(client().hand.mouse_speed, factor, mouse_speed_min, mouse_speed_max);
}

int scree_set_particles(int on) {
  client().particles = on != 0;
  return 1;
}

int scree_set_details(int on) {
  client().details = on != 0;
  return 1;
}

int scree_set_shake(int on) {
  client().shake = on != 0;
  return 1;
}

int scree_set_predict(int on) {
  client().predicts = on != 0;
  return 1;
}

int scree_set_overlay(int on) {
  client().overlay.shown = on != 0;
  return 1;
}

int scree_set_past(int on) {
  client().has_past = on != 0;
  return 1;
}

// ---- the hand

void scree_look(float right, float down) {
  if (std::isfinite(right) && std::isfinite(down)) client().input.turn(right, down);
}

void scree_move(float right, float up, float forward, int fast) {
  if (std::isfinite(right) && std::isfinite(up) && std::isfinite(forward))
    client().input.move({right, up, forward}, fast != 0);
}

void scree_strike() {
  client().input.strike();
}

void scree_hold(int on) {
  client().input.hold(on != 0);
}

void scree_grow(float notches) {
  if (is_within(notches, -100.0F, 100.0F)) client().input.grow(notches);
}

int scree_key(const char* code, int down) {
  return client().input.key(code, down != 0) ? 1 : 0;
}

void scree_keys_up() {
  client().input.keys_up();
}

void scree_gamepad(float left_x, float left_y, float right_x, float right_y, float left_trigger,
                   float right_trigger, uint32_t buttons) {
  for (const float axis : {left_x, left_y, right_x, right_y, left_trigger, right_trigger})
    if (!is_within(axis, -1.5F, 1.5F)) return;
  client().input.pad({left_x, left_y, right_x, right_y, left_trigger, right_trigger, 0}, buttons);
}

int scree_act(const char* action) {
  const std::optional<Action> known = action_named(action);
  if (known) client().input.act(*known);
  return known ? 1 : 0;
}

const char* scree_asked() {
  page().asked = actions_text(client().drain_asked());
  return page().asked.c_str();
}

int scree_set_tool(const char* kind) {
  return set_kind(client().tool.kind, kind);
}

int scree_set_use(const char* use) {
  ToolUse wanted = client().tool.use;
  const int known = set_kind(wanted, use);
  take_up(client().tool, wanted);
  return known;
}

int scree_set_material(const char* name) {
  const std::string wanted = name;
  if (!wanted.empty() && !check_material_name(wanted)) return 0;
  client().tool.material = wanted;
  return 1;
}

int scree_set_pattern(const char* name) {
  const std::optional<SeedPattern> pattern = kind_named<SeedPattern>(name);
  if (!pattern || std::ranges::find(tool_patterns, *pattern) == tool_patterns.end()) return 0;
  client().tool.pattern = *pattern;
  return 1;
}

int scree_set_radius(float metres) {
  return set_number(client().tool.radius_m, metres, tool_radius_min_m, tool_radius_max_m);
}

int scree_set_blast(float metres_per_second) {
  return set_number(client().tool.blast_speed_m_s, metres_per_second, 0.0F, limits::blast_speed_max_m_s);
}

int scree_set_seeds(int seeds) {
  if (seeds < 0 || seeds > static_cast<int>(tool_seeds_max)) return 0;
  client().tool.seeds = static_cast<uint32_t>(seeds);
  return 1;
}

// ---- others

void scree_reconnect() {
  client().visit().session.try_now();
}

int scree_say(const char* text) {
  const std::string line = text;
  const bool fits = !line.empty() && line.size() <= limits::line_bytes_max;
  if (!fits || !client().visit().session.connected()) return 0;
  client().visit().session.say(line);
  return 1;
}

// ---- a game's rules

int scree_send(const char* channel, const uint8_t* bytes, uint32_t count) {
  return client().visit().session.send({channel, {bytes, bytes + count}}) ? 1 : 0;
}

uint32_t scree_heard() {
  if (page().waiting.empty()) page().waiting = client().visit().drain_heard();
  if (page().waiting.empty()) return 0;
  page().heard = std::move(page().waiting.front());
  page().waiting.pop_front();
  return static_cast<uint32_t>(page().heard.bytes.size()) + 1;
}

const char* scree_heard_channel() {
  return page().heard.channel.c_str();
}

const uint8_t* scree_heard_bytes() {
  return page().heard.bytes.data();
}

// ---- sound

uint32_t scree_sounds() {
  Visit& visit = client().visit();
  visit.listen(true);
  page().sounds.clear();
  for (const PieceEvent& event : visit.events())
    if (is_heard(event.kind) && page().sounds.size() < limits::sound_events_max)
      page().sounds.push_back(heard(event, visit.camera));
  return static_cast<uint32_t>(page().sounds.size() * sizeof(SoundEvent));
}

const uint8_t* scree_sounds_bytes() {
  return reinterpret_cast<const uint8_t*>(page().sounds.data());
}

// ---- a replay

void scree_replay_play(int on) {
  client().visit().session.timeline().ask({.play = on != 0 ? ReplayPlay::play : ReplayPlay::pause});
}

int scree_replay_speed(float factor) {
  if (!is_within(std::abs(factor), static_cast<float>(replay_speed_least),
                 static_cast<float>(replay_speed_most)))
    return 0;
  client().visit().session.timeline().ask({.speed = factor});
  return 1;
}

void scree_replay_seek(double tick) {
  if (std::isfinite(tick)) client().visit().session.timeline().seek(tick);
}

// ---- what there is to show

const char* scree_catalogue() {
  page().catalogue = catalogue_text();
  return page().catalogue.c_str();
}

const char* scree_state() {
  page().state = state_text(client());
  return page().state.c_str();
}

const char* scree_names() {
  page().names = names_text(client());
  return page().names.c_str();
}

const char* scree_signs() {
  page().signs = signs_text(client());
  return page().signs.c_str();
}

const char* scree_marks() {
  page().marks = marks_text(client());
  return page().marks.c_str();
}
