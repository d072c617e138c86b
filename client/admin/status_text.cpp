#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "proto/work_rows.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const WorkStatus& work) {
  Json json = Json::object();
  for (const WorkRow& row : work_rows) json[std::string(row.name)] = work.*row.count;
  return json;
}

Json json_of(const LatencyStatus& latency) {
  const auto ms = [](uint32_t us) { return static_cast<double>(us) / 1000.0; };
  Json json;
  for (const LatencyStageRow& stage : latency_stages) {
    json[std::string(stage.name) + "_median"] = ms(latency.median.*stage.us);
    json[std::string(stage.name) + "_worst"] = ms(latency.worst.*stage.us);
  }
  return json;
}

Json json_of(const MaterialLedger& ledger, const std::vector<std::string>& names) {
  Json json = Json::object();
  for (size_t i = 0; i < ledger.rows().size(); ++i) {
    const MaterialLedger::Row& row = ledger.rows()[i];
    if (row == MaterialLedger::Row{}) continue;
    json[i < names.size() ? names[i] : std::to_string(i)] = {{"terrain", row.terrain},
                                                             {"pieces", row.pieces},
                                                             {"dust", row.dust},
                                                             {"poured", row.poured},
                                                             {"converted", row.converted}};
    if (row.stored != 0) json[i < names.size() ? names[i] : std::to_string(i)]["stored"] = row.stored;
  }
  return json;
}

Json json_of(const StatusMessage& status, const std::vector<std::string>& materials) {
  Json refusals = Json::object();
  uint64_t refused = 0;
  for (const RefusalCount& refusal : status.refusals) refused += refusal.count;
  refusals["total"] = refused;
  for (const RefusalCount& refusal : status.refusals) refusals[refusal.reason] = refusal.count;
  Json stages = Json::object();
  for (const StageTime& stage : status.stages) stages[stage.name] = stage.ms;
  return {
      {"tick", status.tick},
      {"clients", status.clients},
      {"pieces", {{"alive", status.pieces}, {"made", status.pieces_made}, {"merged", status.pieces_merged}}},
      {"props", status.props},
      {"ledger",
       {{"terrain", status.ledger_terrain},
        {"pieces", status.ledger_pieces},
        {"dust", status.ledger_dust},
        {"poured", status.ledger_poured},
        {"moved", status.ledger_moved},
        {"stored", status.ledger_stored}}},
      {"materials", json_of(status.materials, materials)},
      {"tick_ms", {{"median", status.tick_median_ms}, {"worst", status.tick_worst_ms}}},
      {"stage_ms", std::move(stages)},
      {"request_ms", json_of(status.latency)},
      {"work", json_of(status.work)},
      {"refusals", std::move(refusals)},
      {"saving", status.saving.empty() ? "none" : status.saving},
      {"saved_tick", status.saved_tick},
      {"chunks",
       {{"in_memory", status.paging.chunks_in},
        {"out", status.paging.chunks_out},
        {"read_per_s", status.paging.chunks_read},
        {"waits", status.paging.chunk_waits},
        {"requests_held", status.paging.requests_held}}}};
}

/// Columns of a line's name.
constexpr size_t name_columns = 26;

std::string value_text(const Json& value) {
  if (!value.is_number_float()) return value.dump();
  char text[400];  // of a double, with three digits behind the point
  std::snprintf(text, sizeof text, "%.3f", value.get<double>());
  return text;
}

/// A group of numbers is "name=number name=number".
std::string line(const std::string& name, const Json& value) {
  std::string text = name + std::string(name.size() < name_columns ? name_columns - name.size() : 0, ' ');
  if (!value.is_object()) return text + " " + value_text(value) + "\n";
  for (const auto& [part, of_part] : value.items()) text += " " + part + "=" + value_text(of_part);
  return text + "\n";
}

}  // namespace

std::string health_json(const HealthMessage& health) {
  Json faults = Json::array();
  for (const HealthFault& fault : health.faults)
    faults.push_back({{"name", fault.name}, {"words", fault.words}});
  const Json json{{"alive", health.alive},
                  {"well", health.well},
                  {"ready", health.ready},
                  {"tick", health.tick},
                  {"faults", std::move(faults)}};
  return json.dump() + "\n";
}

std::string health_lines(const HealthMessage& health) {
  std::string lines = health.well ? "healthy" : "not healthy";
  lines += std::string(health.ready ? ", ready" : ", not ready") + ", at tick " +
           std::to_string(health.tick) + "\n";
  for (const HealthFault& fault : health.faults) lines += fault.name + ": " + fault.words + "\n";
  return lines;
}

std::string status_json(const StatusMessage& status, const std::vector<std::string>& materials) {
  return json_of(status, materials).dump(2) + "\n";
}

std::string status_lines(const StatusMessage& status, const std::vector<std::string>& materials) {
  std::string lines;
  const Json json = json_of(status, materials);
  for (const auto& [name, value] : json.items()) {
    if (!value.is_object()) lines += line(name, value);
    if (!value.is_object()) continue;
    for (const auto& [part, of_part] : value.items()) lines += line(name + "." + part, of_part);
  }
  return lines;
}

}  // namespace scree
