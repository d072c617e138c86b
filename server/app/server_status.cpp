#include "server/app/server_status.h"

#include <nlohmann/json.hpp>

#include "proto/work_rows.h"
#include "server/app/world_facts.h"

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
  StatusJson json = StatusJson::object();
  for (const WorkRow& row : work_rows) json[std::string(row.name)] = work.*row.count;
  return json;
}

StatusJson now_json(const StatusMessage& status, const ServerFacts& facts) {
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
          {"materials", StatusJson::parse(ledger_json(status.materials, *facts.palette))},
          {"chunks_read", status.paging.chunks_read},
          {"saving", status.saving},
          {"saved_tick", status.saved_tick}};
}

StatusJson health_of(const HealthMessage& health) {
  StatusJson faults = StatusJson::array();
  for (const HealthFault& fault : health.faults)
    faults.push_back({{"name", fault.name}, {"words", fault.words}});
  return {
      {"alive", health.alive}, {"well", health.well}, {"ready", health.ready}, {"faults", std::move(faults)}};
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
  const StatusJson json{{"version", SCREE_VERSION},
                        {"tick_rate_hz", facts.tick_rate_hz},
                        {"replay", facts.replay},
                        {"now", now_json(figures.status, facts)},
                        {"health", health_of(figures.health)},
                        {"sessions", std::move(sessions)},
                        {"report", StatusJson::parse(to_json(report))}};
  return json.dump() + "\n";
}

}  // namespace scree
