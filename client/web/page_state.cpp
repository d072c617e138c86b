#include "client/web/page_state.h"

#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "client/viewer/base/camera_text.h"
#include "client/viewer/base/limits.h"
#include "proto/limits.h"
#include "proto/person_name.h"
#include "shared/base/timing.h"
#include "shared/field/mass.h"

namespace scree {
namespace {

using Json = nlohmann::ordered_json;

/// What is no UTF-8 in a text is replaced.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

template <HasRows Kind>
Json names_of() {
  Json names = Json::array();
  for (const Kind kind : all_kinds<Kind>) names.push_back(name_of(kind));
  return names;
}

Json range(double least, double most) {
  return Json::array({least, most});
}

Json range(float least, float most) {
  return range(static_cast<double>(least), static_cast<double>(most));
}

Json limits_json() {
  return {{"view_radius_m", range(limits::view_radius_min_m, limits::view_radius_max_m)},
          {"tool_radius_m", range(tool_radius_min_m, tool_radius_max_m)},
          {"blast_speed_m_s", range(0.0F, limits::blast_speed_max_m_s)},
          {"seeds", range(0.0, static_cast<double>(tool_seeds_max))},
          {"field_of_view_degrees", range(field_of_view_min_degrees, field_of_view_max_degrees)},
          {"look_speed", range(mouse_speed_min, mouse_speed_max)},
          {"replay_speed", range(replay_speed_least, replay_speed_most)},
          {"line_bytes", limits::line_bytes_max},
          {"name_bytes", limits::person_name_bytes_max}};
}

Json connection_json(const ViewerSession& session, double now_s) {
  const char* phase = "connecting";
  if (session.connected())
    phase = "connected";
  else if (session.gave_up())
    phase = "refused";
  else if (session.next_try_s(now_s))
    phase = "lost";
  Json json{{"phase", phase}, {"text", session.description()}, {"replay", session.is_replay()}};
  if (const WelcomeMessage* welcome = session.welcome()) {
    json["role"] = name_of(welcome->role);
    json["session"] = welcome->session;
  }
  if (const auto retry_s = session.next_try_s(now_s)) json["retry_s"] = *retry_s;
  return json;
}

Json status_json(const StatusMessage& status, float voxel_size_m) {
  char hash[20];
  std::snprintf(hash, sizeof hash, "%016" PRIx64, status.field_hash);
  const double voxel_m = static_cast<double>(voxel_size_m);
  const auto volume_m3 = [&](int64_t units) {
    return static_cast<double>(units) / units_per_voxel * voxel_m * voxel_m * voxel_m;
  };
  Json refusals = Json::object();
  for (const RefusalCount& refusal : status.refusals) refusals[refusal.reason] = refusal.count;
  return {{"clients", status.clients},
          {"pieces", status.pieces},
          {"pieces_made", status.pieces_made},
          {"pieces_merged", status.pieces_merged},
          {"tick_median_ms", status.tick_median_ms},
          {"tick_worst_ms", status.tick_worst_ms},
          {"field_hash", hash},
          {"repairs", status.repairs},
          {"chunks_waiting", status.chunks_waiting},
          {"saving", status.saving},
          {"ledger",
           {{"terrain", volume_m3(status.ledger_terrain)},
            {"pieces", volume_m3(status.ledger_pieces)},
            {"dust", volume_m3(status.ledger_dust)},
            {"poured", volume_m3(status.ledger_poured)},
            {"moved", volume_m3(status.ledger_moved)},
            {"stored", volume_m3(status.ledger_stored)}}},
          {"refusals", refusals}};
}

Json traffic_json(const ViewerSession& session) {
  const ConnectionCounters traffic = session.traffic().value_or(ConnectionCounters{});
  return {{"received_bytes", traffic.received_bytes},
          {"sent_bytes", traffic.sent_bytes},
          {"received_bytes_per_s", session.received_bytes_per_s()},
          {"waiting_bytes", traffic.waiting_bytes}};
}

Json mirror_json(const Mirror& mirror, const HudFacts& facts) {
  const MirrorCounters& counters = mirror.counters();
  return {{"frames", counters.frames},
          {"pieces_made", counters.pieces_made},
          {"pieces_merged", counters.pieces_merged},
          {"checks", counters.checks},
          {"mismatches", counters.mismatches},
          {"repairs", counters.repairs_asked},
          {"held_chunks", facts.held_chunks},
          {"edited_bricks", facts.edited_bricks}};
}

std::string hex_colour(const LineColour& colour) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text;
}

/// As a screen shows a linear colour, about.
LineColour shown_colour(const std::array<float, 3>& linear) {
  const auto bright = [](float part) { return static_cast<uint8_t>(255.0F * std::sqrt(part)); };
  return {bright(linear[0]), bright(linear[1]), bright(linear[2]), 255};
}

Json materials_json(const Palette& palette) {
  Json list = Json::array();
  for (const MaterialRow& row : palette.rows)
    list.push_back({{"name", row.name}, {"colour", hex_colour(shown_colour(row.look.colour))}});
  return list;
}

Json tool_json(const Tool& tool) {
  return {{"kind", name_of(tool.kind)},
          {"use", name_of(tool.use)},
          {"material", tool.material},
          {"radius_m", tool.radius_m},
          {"blast_speed_m_s", tool.blast_speed_m_s},
          {"pattern", name_of(tool.pattern)},
          {"seeds", tool.seeds},
          {"seeds_now", seeds_of(tool)}};
}

Json view_json(PageClient& client) {
  Visit& visit = client.visit();
  return {{"method", visit.view->methods().chosen().name},
          {"quality", name_of(visit.quality())},
          {"quality_auto", !client.quality.has_value()},
          {"view_radius_m", visit.view_radius_m()},
          {"particles", client.particles},
          {"details", client.details},
          {"shake", client.shake},
          {"predict", client.predicts},
          {"overlay", client.overlay.shown},
          {"field_of_view_degrees", client.hand.field_of_view_degrees},
          {"look_speed", client.hand.mouse_speed}};
}

Json persons_json(const PersonsMessage& persons) {
  Json list = Json::array();
  for (const Person& person : persons.persons)
    list.push_back({{"session", person.session},
                    {"name", called(person.session, person.name)},
                    {"role", name_of(person.role)}});
  return {{"list", list}, {"more", persons.more}, {"chat", persons.chat}};
}

Json playback_json(const PageClient& client, const Timeline& timeline, double now_s) {
  if (!timeline.is_known()) return nullptr;
  const PlaybackMessage& playback = timeline.playback();
  return {{"moment", timeline.moment(now_s)}, {"first", playback.first},     {"last", playback.last},
          {"speed", playback.speed},          {"playing", playback.playing}, {"grows", playback.grows},
          {"refusal", playback.refusal},      {"marks", client.marks_told()}};
}

Json carried_json(const HudFacts& facts) {
  Json list = Json::array();
  for (const CarriedRow& row : facts.carried) list.push_back({{"name", row.material}, {"m3", row.volume_m3}});
  return list;
}

Json aim_json(const std::optional<ToolAim>& aim, const Palette& palette) {
  if (!aim) return nullptr;
  return {{"beyond", aim->is_beyond},
          {"material", aim->material ? palette.row_or_first(*aim->material).name : std::string()},
          {"m3", aim->volume_m3 ? Json(*aim->volume_m3) : Json()}};
}

Json frame_json(PageClient& client) {
  const FrameTimes times = client.frame_times();
  Visit& visit = client.visit();
  return {{"ms", times.last},
          {"median_ms", times.median},
          {"worst_ms", times.worst},
          {"update_ms", times.update},
          {"draw_ms", times.draw},
          {"apply_worst_ms", visit.session.apply_worst_ms()},
          {"work_worst_ms", visit.view->work_worst_ms()}};
}

Json draw_json(PageClient& client, const HudFacts& facts) {
  const Renderer& renderer = client.visit().view->renderer();
  return {{"method", facts.method},
          {"draws", facts.draw.draws},
          {"triangles", facts.draw.triangles},
          {"pieces", facts.draw.pieces},
          {"kept", facts.draw.resident},
          {"waiting", facts.draw.waiting},
          {"driver", facts.driver},
          {"gl_errors", renderer.gl_errors()},
          {"first_gl_error", renderer.first_gl_error()}};
}

}  // namespace

std::string catalogue_text() {
  Json methods = Json::array();
  for (const MethodEntry& entry : all_methods()) {
    const std::optional<std::string> missing = entry.missing();
    methods.push_back(
        {{"name", entry.name}, {"summary", entry.summary}, {"missing", missing ? Json(*missing) : Json()}});
  }
  Json qualities = names_of<Quality>();
  qualities.insert(qualities.begin(), "auto");
  Json patterns = Json::array();
  for (const SeedPattern pattern : tool_patterns) patterns.push_back(name_of(pattern));
  Json controls = Json::array();
  for (const Binding& binding : bindings())
    controls.push_back({{"action", binding.name},
                        {"key", binding.key_name},
                        {"button", binding.button_name},
                        {"does", binding.does},
                        {"of_replay", binding.of == ControlsOf::replay},
                        {"of_world", binding.of == ControlsOf::live}});
  Json events = Json::array();
  for (const EventKind kind : all_kinds<EventKind>)
    events.push_back({{"kind", name_of(kind)}, {"what", traits_of(kind).what}});
  return text_of({{"methods", methods},
                  {"qualities", qualities},
                  {"tools", names_of<ToolKind>()},
                  {"uses", names_of<ToolUse>()},
                  {"patterns", patterns},
                  {"limits", limits_json()},
                  {"events", events},
                  {"controls", controls}});
}

std::string state_text(PageClient& client) {
  const double now_s = steady_now_s();
  Visit& visit = client.visit();
  ViewerSession& session = visit.session;
  const HudFacts facts = client.facts();
  Json json{{"connection", connection_json(session, now_s)},
            {"notice", facts.notice},
            {"hint", client.hint(now_s)},
            {"mark", {{"number", session.answer().number}, {"refused", session.answer().refused}}},
            {"aim", aim_json(visit.aim(), session.palette())},
            {"camera", camera_text(visit.camera)},
            {"walks", client.whereabouts().walks()},
            {"eye", client.whereabouts().eye().description(session.figures(now_s))},
            {"tick", facts.tick},
            {"tick_rate_hz", facts.tick_rate_hz},
            {"pace", facts.pace},
            {"lost_ticks", facts.lost_ticks},
            {"pieces_near", facts.pieces_near},
            {"props_near", facts.props_near},
            {"carried", carried_json(facts)},
            {"store_m3", facts.store_room_m3 ? Json(*facts.store_room_m3) : Json()},
            {"predictions", facts.predictions},
            {"joined", session.joined(now_s)},
            {"loaded", visit.joined(now_s)},
            {"complete", visit.joined(now_s) && visit.view->methods().complete()},
            {"traffic", traffic_json(session)},
            {"mirror", session.mirror() == nullptr ? Json() : mirror_json(*session.mirror(), facts)},
            {"frame", frame_json(client)},
            {"draw", draw_json(client, facts)},
            {"preparing", nullptr},
            {"latency_ms", facts.latency ? Json(facts.latency->total_ms) : Json()},
            {"status", facts.status ? status_json(*facts.status, facts.voxel_size_m) : Json()},
            {"materials", materials_json(session.palette())},
            {"tool", tool_json(client.tool)},
            {"view", view_json(client)},
            {"persons", persons_json(session.conversation().persons())},
            {"lines", session.conversation().lines(now_s, false)},
            {"playback", playback_json(client, session.timeline(), now_s)}};
  if (facts.preparing)
    json["preparing"] = {{"method", facts.preparing->method}, {"share", facts.preparing->share()}};
  return text_of(json);
}

std::string names_text(PageClient& client) {
  Visit& visit = client.visit();
  const Camera& camera = visit.camera;
  const glm::mat4 projected = camera.projection(client.aspect(), visit.view_radius_m()) * camera.view();
  Json names = Json::array();
  for (const auto& [session, figure] : visit.session.figures(steady_now_s()).all()) {
    const std::optional<glm::vec2> place = Figures::place_of_name(figure, projected);
    if (!place || session == client.whereabouts().eye().person()) continue;
    names.push_back({{"session", session},
                     {"name", called(session, figure.name)},
                     {"colour", hex_colour(figure.colour)},
                     {"x", place->x},
                     {"y", place->y},
                     {"metres", glm::distance(figure.eye_m, camera.eye_m)}});
  }
  return text_of(names);
}

/// By tabs and line feeds, which no text of a sign has: JSON would cost a page more to fetch.
std::string signs_text(PageClient& client) {
  std::string text;
  for (const ShownSign& shown : client.visit().signs(client.aspect(), steady_now_s())) {
    const Sign& sign = shown.sign;
    const MarkerPlace place = shown.marker.value_or(MarkerPlace{});
    const glm::vec2 way = place.way.value_or(glm::vec2(0.0F));
    const auto number = [](float value) { return static_cast<double>(value); };
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, "%d\t#%02x%02x%02x\t%.4f\t%.4f\t%.4f\t%.2f\t%.2f\t%.2f\t",
                  static_cast<int>(sign.kind), sign.colour[0], sign.colour[1], sign.colour[2],
                  number(sign.share), number(place.at.x), number(place.at.y), number(place.opacity),
                  number(way.x), number(way.y));
    text += numbers + sign.name + '\t' + shown.words + '\n';
  }
  return text;
}

std::string marks_text(PageClient& client) {
  const MarksMessage& told = client.visit().session.timeline().marks();
  Json marks = Json::array();
  for (const Mark& mark : told.marks)
    marks.push_back({{"kind", name_of(mark.kind)}, {"column", mark.column}, {"count", mark.count}});
  return text_of({{"first", told.first},
                  {"ticks_per_column", told.ticks_per_column},
                  {"read_to", told.read_to},
                  {"marks", marks}});
}

std::string actions_text(const std::vector<Action>& actions) {
  Json names = Json::array();
  for (const Action action : actions)
    for (const Binding& binding : bindings())
      if (binding.action == action) names.push_back(binding.name);
  return text_of(names);
}

}  // namespace scree
