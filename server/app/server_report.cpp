#include "server/app/server_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "server/app/web_folder.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

std::string hex(uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

/// Bytes of an operation of this kind, on average.
template <typename Kind>
double mean(const PublisherStats& sent) {
  const uint64_t count = sent.operations.of<Kind>();
  return count == 0 ? 0.0 : static_cast<double>(sent.operation_bytes.of<Kind>()) / static_cast<double>(count);
}

Json json_of(const Durations& durations) {
  return {{"count", durations.count()},
          {"median", durations.quantile_ms(0.5)},
          {"p99", durations.quantile_ms(0.99)},
          {"worst", durations.worst_ms()}};
}

Json json_of(const Ledger& ledger) {
  return {{"terrain", ledger.terrain}, {"pieces", ledger.pieces}, {"dust", ledger.dust},
          {"poured", ledger.poured},   {"moved", ledger.moved},   {"error", ledger.error()},
          {"stored", ledger.stored}};
}

Json json_of(const SettingValues& settings) {
  Json json = Json::object();
  for (const SettingValue& setting : settings) json[setting.name] = setting.value;
  return json;
}

Json json_of(const WorkReport& work) {
  return {{"budget_us", work.budget_us},
          {"worst_us", work.worst_us},
          {"ticks_cut_short", work.ticks_cut_short},
          {"first_cut_short", work.first_cut_short},
          {"last_cut_short", work.last_cut_short},
          {"ticks_merging_sooner", work.ticks_merging_sooner},
          {"requests_waiting_most", work.requests_waiting_most},
          {"cuts_put_off_most", work.refractures_put_off_most},
          {"merges_put_off_most", work.merges_put_off_most},
          {"breaks_left_out", work.breaks_left_out},
          {"dents_left_out", work.dents_left_out},
          {"blows_left_out", work.blows_left_out},
          {"supports_put_off_most", work.supports_put_off_most},
          {"supports_given_up", work.supports_given_up},
          {"islands_put_off_most", work.islands_put_off_most},
          {"slides_put_off_most", work.slides_put_off_most},
          {"islands_too_large", work.islands_too_large},
          {"memory_mb", work.memory_mb}};
}

/// Reasons that were never given are left out.
Json json_of(const RefusalCounts& refusals) {
  Json by_reason = Json::object();
  for (size_t i = 0; i < refusal_reasons; ++i) {
    const auto reason = static_cast<Refusal>(i);
    if (refusals.of(reason) > 0) by_reason[std::string(name_of(reason))] = refusals.of(reason);
  }
  return {{"total", refusals.total()}, {"by_reason", std::move(by_reason)}};
}

Json json_of(const LatencyCounts& latency) {
  Json json = Json::object();
  for (size_t i = 0; i < latency_stages.size(); ++i)
    json[std::string(latency_stages[i].name)] = json_of(latency[i]);
  return json;
}

Json json_of(const NetStats& net) {
  const PublisherStats& sent = net.published;
  return {{"now", net.sessions},
          {"joined", net.sessions_joined},
          {"resumed", net.sessions_resumed},
          {"tickets_void", net.tickets_void},
          {"refused", net.sessions_refused},
          {"cut", net.sessions_disconnected},
          {"turned_away", net.turned_away},
          {"resets", sent.resets},
          {"repairs", sent.repairs},
          {"requests", net.requests},
          {"requests_refused", net.requests_refused},
          {"messages_unknown", net.messages_unknown},
          {"publish_waits", net.publish_waits},
          {"bytes_out", net.bytes_out},
          {"bytes_out_held", net.bytes_out_held}};
}

Json json_of(const WebStats& web) {
  return {{"requests", web.requests},     {"files", web.files},           {"not_modified", web.not_modified},
          {"bytes_sent", web.bytes_sent}, {"websockets", web.websockets}, {"connections", web.connections}};
}

/// What a program that watches asks: whether it is written, and if not, since when and why.
void add_health(Json& json, const StoreHealth& health) {
  json["state"] = health.ok() ? "ok" : "retrying";
  if (health.ok()) return;
  json["since"] = iso_time(health.since_unix_ms);
  json["error"] = *health.because;
}

Json recording_json(const ServerReport& report) {
  const RecordingSize& size = report.record_size;
  Json json{
      {"path", report.record_path},   {"ticks", report.ticks_recorded}, {"ticks_lost", report.recording.lost},
      {"waits", report.record_waits}, {"bytes", size.file_bytes},       {"log_bytes", size.log_bytes}};
  if (!size.over_limit.empty()) json["over_limit"] = size.over_limit;
  add_health(json, report.recording);
  return json;
}

Json json_of(const std::string& path, const SaverStatus& saving) {
  Json json{{"path", path},
            {"saved_tick", saving.saved_tick},
            {"saves", saving.saves},
            {"skipped", saving.skipped},
            {"failures", saving.failures},
            {"bytes_written", saving.bytes_written},
            {"save_worst_ms", saving.save_worst_ms}};
  add_health(json, saving.health);
  return json;
}

}  // namespace

void WorkReport::add(Tick tick, const TickWork& work) {
  budget_us = work.budget_us;
  worst_us = std::max(worst_us, work.estimate_us);
  if (work.has_leftovers()) {
    ++ticks_cut_short;
    if (first_cut_short == 0) first_cut_short = tick;
    last_cut_short = tick;
  }
  ticks_merging_sooner += work.merging_sooner ? 1 : 0;
  requests_waiting_most = std::max(requests_waiting_most, work.requests_waiting);
  refractures_put_off_most = std::max(refractures_put_off_most, work.refractures_put_off);
  merges_put_off_most = std::max(merges_put_off_most, work.merges_put_off);
  breaks_left_out += work.breaks_left_out;
  dents_left_out += work.dents_left_out;
  blows_left_out += work.blows_left_out;
  supports_put_off_most = std::max(supports_put_off_most, work.supports_put_off);
  supports_given_up += work.supports_given_up;
  islands_put_off_most = std::max(islands_put_off_most, work.islands_put_off);
  slides_put_off_most = std::max(slides_put_off_most, work.slides_put_off);
  islands_too_large += work.islands_too_large;
}

void ServerReport::add(const TickDelta& delta) {
  ++ticks;
  last_tick = delta.tick;
  for (const AppliedOperation& applied : delta.operations) {
    ++operations[applied.operation];
    pieces_merged += pieces_merged_by(applied.operation);
  }
  pieces_made += delta.spawned.size();
  pieces_alive = delta.pieces.size();
  props = delta.props.size();
  ledger = delta.ledger;
  work.add(delta.tick, delta.work);
  if (!delta.settings.empty()) settings = delta.settings;
  field_hash = delta.field_hash;
  state_hash = delta.state_hash;
  for (const TickStageRow& row : tick_stages) {
    const size_t stage = index_of(row.stage);
    if (!row.only_when_acting || delta.times.acted[stage]) stages[stage].add(delta.times[row.stage]);
  }
  tick.add(delta.times.total_ms());
  for (size_t stage = 0; stage < tick_stages.size(); ++stage) {
    stage_sums.ms[stage] += delta.times.ms[stage];
    stage_sums.model_ms[stage] += delta.times.model_ms[stage];
  }
  model.add(delta.work.estimate_us / 1e3);
  budget_s += delta.work.budget_us / 1e6;
  last_work = delta.work;
  persons = delta.persons.size();
  kept = delta.kept.size();
  for (const Reply& reply : delta.replies) ++(reply.refusal.empty() ? requests_granted : requests_refused);
}

void ServerReport::add(const TickParts& parts) {
  for (size_t part = 0; part < parts.ms.size(); ++part) part_sums.ms[part] += parts.ms[part];
  part_sums.cpu_ms += parts.cpu_ms;
}

std::string to_json(const ServerReport& report) {
  const PublisherStats& sent = report.net.published;
  Json json{{"ticks", report.ticks}, {"last_tick", report.last_tick}, {"seconds", report.seconds}};
  report.operations.for_each([&](std::string_view name, uint64_t count) { json[std::string(name)] = count; });
  json.update({{"pieces_made", report.pieces_made},
               {"pieces_merged", report.pieces_merged},
               {"pieces_lost", report.operations.of<DiscardOperation>()},
               {"pieces_alive", report.pieces_alive},
               {"props", report.props},
               {"ledger", json_of(report.ledger)},
               {"settings", json_of(report.settings)},
               {"field_hash", hex(report.field_hash)},
               {"state_hash", hex(report.state_hash)},
               {"work", json_of(report.work)},
               {"late_ticks", report.late_ticks},
               {"overruns", report.overruns},
               {"bytes_sent", sent.sent_bytes},
               {"frame_bytes", sent.frame_bytes},
               {"transform_bytes", sent.transform_bytes},
               {"chunk_bytes", sent.chunk_bytes},
               {"piece_bytes", sent.piece_bytes},
               {"ground_bytes", sent.ground_bytes},
               {"tile_bytes", sent.tile_bytes},
               {"stone_bytes", sent.stone_bytes},
               {"content_bytes", sent.content_bytes},
               {"kept_bytes", sent.kept_bytes},
               {"chunks_kept", sent.chunks_kept},
               {"bytes_per_carve", mean<CarveOperation>(sent)},
               {"bytes_per_merge", mean<StampOperation>(sent)},
               {"sessions", json_of(report.net)},
               {"web", json_of(report.net.web)},
               {"refusals", json_of(report.net.refusals)},
               {"request_latency_ms", json_of(report.latency)}});
  Json stages = Json::object();
  for (const TickStageRow& row : tick_stages)
    stages[std::string(row.name)] = json_of(report.stages[index_of(row.stage)]);
  stages["tick"] = json_of(report.tick);
  stages["whole_tick"] = json_of(report.whole_tick);
  stages["whole_tick_cpu"] = json_of(report.whole_tick_cpu);
  stages["terrain_in"] = json_of(report.terrain_in);
  stages["keep"] = json_of(report.after_tick);
  json["stages_ms"] = stages;
  json["resident_mb"] = report.resident_mb;
  if (!report.record_path.empty()) json["recording"] = recording_json(report);
  if (!report.events_path.empty()) {
    Json events{{"path", report.events_path},
                {"written", report.events.written},
                {"lost", report.events.health.lost}};
    add_health(events, report.events.health);
    json["events"] = std::move(events);
  }
  json["chunks"] = {{"in_memory", report.paging.chunks_in},
                    {"out", report.paging.chunks_out},
                    {"read", report.paging.chunks_read},
                    {"waits", report.paging.waits},
                    {"requests_held", report.requests_held}};
  if (!report.world_path.empty()) json["world"] = json_of(report.world_path, report.saving);
  if (report.error) json["error"] = *report.error;
  return json.dump(2) + "\n";
}

std::string listening_line(uint16_t port, const NetConfig& net) {
  Json line{{"listening", port}, {"bind", net.bind}};
  if (!net.web.folder.empty())
    line["page"] = page_url(net.bind, port, !net.access.tls_certificate_path.empty());
  return line.dump();
}

}  // namespace scree
