#include "server/store/event_lines.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shared/base/wall_clock.h"

namespace scree {

namespace {

double seconds_of(const Event& event, const EventContext& context) {
  return static_cast<double>(event.tick) / context.tick_rate_hz;
}

/// A thousandth is enough to find a place, and keeps lines short.
double rounded(double value) {
  return std::round(value * 1000.0) / 1000.0;
}

std::optional<float> ms_of(const Event& event, const EventContext& context) {
  return event.ms > 0.0F ? std::optional(event.ms) : context.tick_ms;
}

/// As scree token shows it.
std::string token_text(const Event& event, const EventContext& context) {
  const uint64_t id = event.token_id != 0 ? event.token_id : context.who.token_id;
  return id == 0 ? std::string() : fmt::format("{:016x}", id);
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string json_line(const Event& event, const EventContext& context) {
  nlohmann::ordered_json line{
      {"event", name_of(event.kind)}, {"tick", event.tick}, {"time_s", rounded(seconds_of(event, context))}};
  if (context.unix_ms != 0) line["at"] = iso_time(context.unix_ms);
  if (event.place_m) {
    line["x_m"] = rounded(event.place_m->x);
    line["y_m"] = rounded(event.place_m->y);
    line["z_m"] = rounded(event.place_m->z);
  }
  if (event.volume_m3 > 0.0F) line["volume_m3"] = rounded(event.volume_m3);
  if (event.pieces > 0) line["pieces"] = event.pieces;
  if (event.session != 0) line["session"] = event.session;
  if (!context.who.name.empty()) line["name"] = context.who.name;
  if (const std::string token = token_text(event, context); !token.empty()) line["token"] = token;
  if (const auto ms = ms_of(event, context)) line["ms"] = rounded(*ms);
  if (!event.text.empty()) line["text"] = event.text;
  if (event.body != 0) line["body"] = event.body;
  if (event.other != 0) line["other"] = event.other;
  if (event.tag != 0) line["tag"] = event.tag;
  if (event.normal != glm::vec3(0.0F))
    line["normal"] = {rounded(event.normal.x), rounded(event.normal.y), rounded(event.normal.z)};
  if (event.impulse_n_s > 0.0F) line["impulse_n_s"] = rounded(event.impulse_n_s);
  if (event.energy_j > 0.0F) line["energy_j"] = rounded(event.energy_j);
  if (event.left_out > 0) line["left_out"] = event.left_out;
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

namespace {

/// The columns from body on, each after a comma.
std::string csv_of_bodies(const Event& event) {
  const auto number = [](auto value) { return value == 0 ? std::string(",") : fmt::format(",{}", value); };
  const auto measure = [](float value) {
    return value == 0.0F ? std::string(",") : fmt::format(",{:.3f}", value);
  };
  std::string line = number(event.body) + number(event.other) + number(event.tag);
  const bool has_normal = event.normal != glm::vec3(0.0F);
  line += has_normal ? fmt::format(",{:.3f},{:.3f},{:.3f}", event.normal.x, event.normal.y, event.normal.z)
                     : std::string(",,,");
  return line + measure(event.impulse_n_s) + measure(event.energy_j) + number(event.left_out);
}

}  // namespace

std::string csv_line(const Event& event, const EventContext& context) {
  std::string line = fmt::format("{},{:.3f},{}", event.tick, seconds_of(event, context), name_of(event.kind));
  line += event.place_m
              ? fmt::format(",{:.3f},{:.3f},{:.3f}", event.place_m->x, event.place_m->y, event.place_m->z)
              : std::string(",,,");
  line += event.volume_m3 > 0.0F ? fmt::format(",{:.3f}", event.volume_m3) : std::string(",");
  line += event.pieces > 0 ? fmt::format(",{}", event.pieces) : std::string(",");
  line += event.session != 0 ? fmt::format(",{}", event.session) : std::string(",");
  const auto ms = ms_of(event, context);
  line += ms ? fmt::format(",{:.3f}", *ms) : std::string(",");
  return fmt::format("{},{},{},{},{}{}", line, csv_field(event.text),
                     context.unix_ms == 0 ? std::string() : iso_time(context.unix_ms),
                     csv_field(context.who.name), token_text(event, context), csv_of_bodies(event));
}

}  // namespace scree
