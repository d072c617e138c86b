#include "server/app/server_status.h"

#include <nlohmann/json.hpp>

namespace scree {

namespace {

using StatusJson = nlohmann::ordered_json;

StatusJson latency_json(const LatencyStatus& latency) {
  const auto ms_of = [](uint32_t us) { return static_cast<double>(us) / 1e3; };
  StatusJson json = StatusJson::object();
  for (const LatencyStageRow& stage : latency_stages)
    json[std::string(stage.name)] = {{"median", ms_of(latency.median.*stage.us)},
                                     {"worst", ms_of(latency.worst.*stage.us)}};
  return json;
}

StatusJson work_json(const WorkStatus& work) {
  return {{"budget_us", work.budget_us},
          {"worst_us", work.worst_us},
          {"requests_waiting", work.requests_waiting},
          {"merges_put_off", work.merges_put_off},
          {"breaks_left_out", work.breaks_left_out},
          {"dents_left_out", work.dents_left_out},
          {"ticks_cut_short", work.ticks_cut_short},
          {"ticks_merging_sooner", work.ticks_merging_sooner},
          {"supports_put_off", work.supports_put_off},
          {"islands_put_off", work.islands_put_off},
          {"islands_too_large", work.islands_too_large}};
}

StatusJson now_json(const StatusMessage& status) {
  StatusJson stages = StatusJson::object();
  for (const StageTime& stage : status.stages) stages[stage.name] = stage.ms;
  return {{"tick", status.tick},
          {"clients", status.clients},
          {"pieces", status.pieces},
          {"tick_median_ms", status.tick_median_ms},
          {"tick_worst_ms", status.tick_worst_ms},
          {"stages_ms", std::move(stages)},
          {"latency_ms", latency_json(status.latency)},
          {"work", work_json(status.work)},
          {"chunks_read", status.paging.chunks_read},
          {"saving", status.saving},
          {"saved_tick", status.saved_tick}};
}

StatusJson session_json(const SessionRow& row) {
  return {{"session", row.session},    {"name", row.name},
          {"program", row.program},    {"address", row.address},
          {"role", name_of(row.role)}, {"token_id", row.token_id},
          {"seconds", row.joined_s},   {"sent_bytes", row.sent_bytes},
          {"encrypted", row.encrypted}};
}

}  // namespace

std::string status_json(const ServerReport& report, const NetFigures& figures, const ServerFacts& facts) {
  StatusJson sessions = StatusJson::array();
  for (const SessionRow& row : figures.sessions) sessions.push_back(session_json(row));
  const StatusJson json{{"version", SCREE_VERSION},        {"tick_rate_hz", facts.tick_rate_hz},
                        {"replay", facts.replay},          {"now", now_json(figures.status)},
                        {"sessions", std::move(sessions)}, {"report", StatusJson::parse(to_json(report))}};
  return json.dump() + "\n";
}

}  // namespace scree
