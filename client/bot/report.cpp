#include "client/bot/report.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "shared/base/quantile.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

std::string hex(uint64_t value) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (size_t i = 16; i-- > 0; value >>= 4U) text[i] = digits[value & 15U];
  return text;
}

Json latency(const std::vector<double>& values) {
  return {{"count", values.size()},
          {"median", quantile(values, 0.5)},
          {"p99", quantile(values, 0.99)},
          {"worst", quantile(values, 1.0)}};
}

Json stages(const BotReport& report) {
  Json json{{"network", latency(report.network_latencies_ms)}};
  for (size_t i = 0; i < latency_stages.size(); ++i)
    json[std::string(latency_stages[i].name)] = latency(report.server_latencies_ms[i]);
  return json;
}

Json counts(const std::map<std::string, uint32_t>& refusals) {
  Json json = Json::object();
  for (const auto& [reason, count] : refusals) json[reason] = count;
  return json;
}

Json carves(const BotReport& report) {
  return {{"asked", report.carves_asked},       {"accepted", report.carves_accepted},
          {"saved", report.carves_saved},       {"refused", report.carves_refused},
          {"lost", report.carves_lost},         {"seen", report.seen.operations.of<CarveOperation>()},
          {"refusals", counts(report.refusals)}};
}

Json moves(const MoveReport& moves, const BotReport& report) {
  return {{"asked", moves.asked},
          {"accepted", moves.accepted},
          {"refused", moves.refused},
          {"lost", moves.lost},
          {"mass", moves.mass},
          {"m3", m3_of(moves.mass, report)},
          {"refusals", counts(moves.refusals)}};
}

Json carried(const BotReport& report) {
  Json json = Json::object();
  for (const auto& [material, mass] : report.carried)
    json[material] = {{"mass", mass}, {"m3", m3_of(mass, report)}};
  return json;
}

Json walks(const WalkReport& walks) {
  const double minutes = walks.seconds / 60.0;
  return {{"done", walks.done},
          {"inputs", walks.inputs},
          {"seconds", walks.seconds},
          {"refused", walks.refused},
          {"corrections", walks.corrections},
          {"corrections_per_minute", minutes > 0.0 ? static_cast<double>(walks.corrections) / minutes : 0.0},
          {"correction_worst_m", walks.correction_worst_m},
          {"depth_worst_m", walks.depth_worst_m}};
}

Json json_of(const Sign& sign) {
  Json json{{"name", sign.name}, {"kind", name_of(sign.kind)}, {"text", sign.text}};
  if (sign.kind == SignKind::bar) json["share"] = sign.share;
  if (sign.kind == SignKind::marker)
    json["place_m"] = Json::array({sign.place_m.x, sign.place_m.y, sign.place_m.z});
  if (sign.until != 0) json["until"] = sign.until;
  return json;
}

/// Bytes as text; what is none is replaced (to_json()).
Json rules(const BotReport& report) {
  Json signs = Json::array(), heard = Json::array();
  for (const Sign& sign : report.signs) signs.push_back(json_of(sign));
  for (const ChannelData& data : report.rules.heard)
    heard.push_back({{"channel", data.channel}, {"data", std::string(data.bytes.begin(), data.bytes.end())}});
  Json said = Json::array();
  for (const SaidMessage& line : report.rules.said)
    said.push_back({{"session", line.session}, {"name", line.name}, {"text", line.text}});
  return {{"signs", signs},
          {"sign_lists", report.rules.signs},
          {"cues", report.rules.cues},
          {"messages", report.rules.messages},
          {"heard", heard},
          {"lines", report.rules.lines},
          {"said", said}};
}

Json ledger(const StatusMessage& status) {
  const int64_t error = status.ledger_terrain + status.ledger_pieces + status.ledger_dust +
                        status.ledger_stored - status.ledger_poured;
  const double moved = static_cast<double>(std::max<int64_t>(status.ledger_moved, 1));
  return {{"terrain", status.ledger_terrain},
          {"pieces", status.ledger_pieces},
          {"dust", status.ledger_dust},
          {"poured", status.ledger_poured},
          {"moved", status.ledger_moved},
          {"stored", status.ledger_stored},
          {"error", error},
          {"error_share", static_cast<double>(error) / moved}};
}

Json bytes(const BotReport& report) {
  return {{"received", report.bytes.total()},
          {"sent", report.bytes_sent},
          {"frames", report.bytes.frames},
          {"transforms", report.bytes.transforms},
          {"chunks", report.bytes.chunks},
          {"pieces", report.bytes.pieces},
          {"tiles", report.bytes.tiles},
          {"other", report.bytes.other},
          {"operations", report.seen.operation_bytes}};
}

Json cost(const OperationCost& cost) {
  return {{"count", cost.count}, {"mean", cost.mean()}, {"worst", cost.bytes_worst}};
}

}  // namespace

std::string to_json(const BotReport& report) {
  const MirrorCounters& seen = report.seen;
  const StatusMessage& status = report.status;
  Json json;
  json["ok"] = report.failure.empty();
  json["failure"] = report.failure;
  json["refusal"] = report.refusal;
  json["server"] = report.server;
  json["protocol"] = report.welcome.protocol;
  json["replay"] = report.welcome.replay;
  json["role"] = name_of(report.welcome.role);
  json["terrain"] = {{"kind", name_of(report.welcome.terrain.kind)},
                     {"seed", report.welcome.terrain.random_seed},
                     {"voxel_size_m", report.welcome.terrain.voxel_size_m}};
  if (report.welcome.heights)
    json["terrain"] = {{"kind", "heights"},
                       {"coarsest_tile", hex_of(report.welcome.heights->top)},
                       {"voxel_size_m", report.welcome.terrain.voxel_size_m}};
  json["duration_s"] = report.duration_s;
  json["connections"] = report.connections;
  json["settled"] = report.settled;
  json["carves"] = carves(report);
  if (report.digs.asked > 0) json["digs"] = moves(report.digs, report);
  if (report.places.asked > 0) json["places"] = moves(report.places, report);
  if (report.digs.asked > 0 || report.places.asked > 0) json["carried"] = carried(report);
  if (report.walks.inputs > 0 || report.walks.refused > 0) json["walks"] = walks(report.walks);
  const RulesReport& told = report.rules;
  if (told.signs + told.cues + told.messages > 0) json["rules"] = rules(report);
  json["pieces"] = {{"made", seen.pieces_made},
                    {"merged", seen.pieces_merged},
                    {"discarded", seen.operations.of<DiscardOperation>()},
                    {"received_whole", seen.pieces_sent},
                    {"alive", report.pieces_alive}};
  json["server_pieces"] = {
      {"made", status.pieces_made}, {"merged", status.pieces_merged}, {"alive", status.pieces}};
  json["ledger"] = ledger(status);
  json["bytes"] = bytes(report);
  json["bytes_per_carve"] = cost(report.costs.of<CarveOperation>());
  json["bytes_per_merge"] = cost(report.costs.of<StampOperation>());
  json["frames"] = seen.frames;
  json["chunks"] = {{"held", report.chunks_held},
                    {"received_whole", seen.chunks},
                    {"kept", seen.chunks_kept},
                    {"dropped", seen.dropped_chunks},
                    {"patched_bricks", seen.patched_bricks}};
  json["checks"] = seen.checks;
  json["mismatches"] = seen.mismatches;
  json["repairs"] = {{"asked", seen.repairs_asked}, {"arrived", seen.repairs_arrived}};
  json["resets"] = seen.resets;
  json["hash"] = {{"equal", report.hash.equal},
                  {"compared", report.hash.compared},
                  {"tick", report.hash.tick},
                  {"client", hex(report.hash.client)},
                  {"server", hex(report.hash.server)}};
  json["edit_latency_ms"] = latency(report.edit_latencies_ms);
  json["reply_latency_ms"] = latency(report.reply_latencies_ms);
  json["reply_stages_ms"] = stages(report);
  json["tick"] = {{"last", status.tick},
                  {"per_s", report.ticks_per_s},
                  {"median_ms", quantile(report.tick_medians_ms, 0.5)},
                  {"worst_ms", report.tick_worst_ms}};
  // Reasons come from the wire: bytes that are no UTF-8 are replaced, so that nothing is thrown.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

double m3_of(MassUnits mass, const BotReport& report) {
  const double voxel_m = report.welcome.terrain.voxel_size_m;
  return static_cast<double>(mass) / units_per_voxel * voxel_m * voxel_m * voxel_m;
}

std::string all_refused(const BotReport& report) {
  if (report.carves_accepted + report.digs.accepted + report.places.accepted > 0) return {};
  std::vector<std::string> kinds;
  std::map<std::string, uint32_t> refusals;
  const auto add = [&](const char* kind, const std::map<std::string, uint32_t>& of_kind) {
    if (!of_kind.empty()) kinds.emplace_back(kind);
    for (const auto& [reason, count] : of_kind) refusals[reason] += count;
  };
  add("carve", report.refusals);
  add("dig", report.digs.refusals);
  add("place", report.places.refusals);
  if (refusals.empty()) return {};
  std::string why;
  for (const auto& [reason, count] : refusals)
    why += fmt::format("{}{} ({})", why.empty() ? "" : ", ", reason, count);
  return fmt::format("every {} was refused: {}", fmt::join(kinds, " and every "), why);
}

}  // namespace scree
