#include <cmath>
#include <nlohmann/json.hpp>

#include "server/flight/flight_recorder.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

/// To a thousandth, so that a line is short.
double rounded(float ms) {
  return std::round(static_cast<double>(ms) * 1e3) / 1e3;
}

Json stages_json(const std::array<float, tick_stages.size()>& ms) {
  Json json = Json::object();
  for (const TickStageRow& row : tick_stages)
    if (const float stage_ms = ms[index_of(row.stage)]; stage_ms > 0.0F)
      json[std::string(row.name)] = rounded(stage_ms);
  return json;
}

Json cause_json(const FlightCause& cause, const FlightNames& names) {
  Json json{{"stage", row_of(cause.stage).name}, {"party", cause.party}, {"session", cause.session}};
  const uint64_t who = cause.session != 0 ? cause.session : cause.party;
  json["name"] = who == 0 ? std::string() : names.session(who);
  const bool is_asked = cause.request != FlightCause::no_request && names.request;
  json["request"] = is_asked ? Json(names.request(cause.request)) : Json();
  json.update({{"count", cause.count},
               {"clock_ms", rounded(cause.clock_ms)},
               {"price_ms", rounded(cause.price_ms)},
               {"place", {rounded(cause.place_m.x), rounded(cause.place_m.y), rounded(cause.place_m.z)}}});
  return json;
}

}  // namespace

std::string slow_line(const SlowEpisode& slow, std::span<const FlightCause> causes, const FlightNames& names,
                      uint64_t left_out) {
  const FlightTick& tick = slow.worst;
  Json by = Json::array();
  for (const FlightCause& cause : causes) by.push_back(cause_json(cause, names));
  Json json{{"time", iso_time(tick.unix_ms)},
            {"tick", tick.tick},
            {"culprit", name_of(slow.diagnosis.culprit)},
            {"words", slow.words},
            {"late_ms", rounded(tick.late_ms())},
            {"began_late_ms", rounded(tick.began_late_ms)},
            {"wall_ms", rounded(tick.wall_ms)},
            {"cpu_ms", {{"thread", rounded(tick.thread_cpu_ms)}, {"process", rounded(tick.process_cpu_ms)}}},
            {"parts_ms",
             {{"terrain_in", rounded(tick.terrain_in_ms)},
              {"world", rounded(tick.world_ms)},
              {"record", rounded(tick.record_ms)},
              {"keep", rounded(tick.keep_ms)},
              {"hand_over", rounded(tick.hand_over_ms)}}},
            {"stage_ms", stages_json(tick.stage_ms)},
            {"price_ms", stages_json(tick.model_ms)},
            {"storage",
             {{"save_ms", rounded(tick.save_ms)},
              {"saves_skipped", tick.saves_skipped},
              {"chunk_waits", tick.chunk_waits}}},
            {"network",
             {{"lag_ms", rounded(tick.net_lag_ms)},
              {"busy_ms", rounded(tick.net_busy_ms)},
              {"cpu_ms", rounded(tick.net_cpu_ms)}}},
            {"process", {{"major_faults", tick.major_faults}, {"preempted", tick.preempted}}},
            {"work",
             {{"budget_us", tick.budget_us},
              {"estimate_us", tick.estimate_us},
              {"pieces", tick.pieces},
              {"contacts", tick.contacts},
              {"requests_waiting", tick.requests_waiting}}},
            {"causes", std::move(by)}};
  if (left_out > 0) json["left_out"] = left_out;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace scree
