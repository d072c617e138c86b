#include "server/app/server_metrics.h"

#include <array>
#include <charconv>
#include <ctime>

#include "server/app/memory_limit.h"
#include "server/app/resident_memory.h"
#include "server/metrics/figure_page.h"
#include "server/work/memory.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

constexpr double ms_per_s = 1e3;

/// Bounds of histograms, s. That of a tick at 60 Hz, and of one at 30 Hz, are among the first.
constexpr std::array tick_bounds_s{0.0005, 0.001,  0.002, 0.004, 0.008, 0.0167,
                                   0.0333, 0.0667, 0.15,  0.5,   2.0};
constexpr std::array stage_bounds_s{0.0002, 0.0005, 0.001, 0.002, 0.004, 0.008, 0.0167, 0.0333, 0.1, 0.5};
constexpr std::array wait_bounds_s{0.001, 0.002, 0.005, 0.01, 0.0167, 0.0333, 0.0667, 0.15, 0.5, 1.0, 5.0};
constexpr std::array disk_bounds_s{0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 5.0, 10.0};

FigureLabels label(const char* name, std::string_view value) {
  return {{name, std::string(value)}};
}

/// Totals of one name, by the values of one label.
template <typename Count>
void totals(FigurePage& page, const char* name, const char* help, const char* by,
            std::initializer_list<std::pair<const char*, Count>> counts) {
  for (const auto& [value, count] : counts)
    page.total(name, help, static_cast<double>(count), label(by, value));
}

template <typename Count>
void states(FigurePage& page, const char* name, const char* help, const char* by,
            std::initializer_list<std::pair<const char*, Count>> counts) {
  for (const auto& [value, count] : counts)
    page.state(name, help, static_cast<double>(count), label(by, value));
}

double number_of(const SettingValues& settings, std::string_view name) {
  double number = 0.0;
  for (const SettingValue& setting : settings)
    if (setting.name == name)
      std::from_chars(setting.value.data(), setting.value.data() + setting.value.size(), number);
  return number;
}

double process_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

void add_process(FigurePage& page, const ServerReport& report, const NetFigures& figures,
                 const ServerFacts& facts, const MetricsFacts& more) {
  page.state("scree_build_info", "Always 1; the label is the server's version.", 1,
             label("version", SCREE_VERSION));
  page.state("scree_replay", "1 while the server plays a recording, else 0.", facts.replay ? 1 : 0);
  page.state("process_start_time_seconds", "Start of the server, in seconds since 1970.",
             static_cast<double>(more.started_unix_s));
  page.total("process_cpu_seconds_total", "Processor time of all threads.", process_cpu_s());
  page.state("process_resident_memory_bytes", "What the process has in RAM.",
             report.resident_mb * bytes_per_mb);
  if (const double limit = memory_limit_bytes(); limit > 0.0)
    page.state("scree_memory_limit_bytes", "What the machine, or the server's container, gives at most.",
               limit);
  page.state("scree_memory_max_bytes", "The setting memory-max.",
             number_of(report.settings, "memory-max") * bytes_per_mb);
  page.state("scree_terrain_memory_bytes", "Memory of the terrain, as the server estimates it.",
             report.paging.memory_mb * bytes_per_mb);
  states<bool>(
      page, "scree_healthy", "1 while that holds which /livez, /healthz and /readyz say, else 0.", "path",
      {{"livez", figures.health.alive}, {"healthz", figures.health.well}, {"readyz", figures.health.ready}});
}

void add_ticks(FigurePage& page, const ServerReport& report, const ServerFacts& facts) {
  page.total("scree_ticks_total", "Ticks that were stepped, or played.", static_cast<double>(report.ticks));
  page.state("scree_tick_rate_hertz", "Ticks that are due in a second.", facts.tick_rate_hz);
  page.durations("scree_tick_duration_seconds", "Ticks with all that the simulation's thread does in one.",
                 report.whole_tick, tick_bounds_s);
  page.durations("scree_tick_modelled_seconds", "The work of ticks, as the server's model estimates it.",
                 report.model, tick_bounds_s);
  page.total("scree_tick_budget_seconds_total",
             "The work that all ticks together might have done, by the model.", report.budget_s);
  page.total("scree_tick_cpu_seconds_total", "Processor time of the simulation's thread.",
             report.part_sums.cpu_ms / ms_per_s);
  for (const TickPart part : all_kinds<TickPart>)
    page.total("scree_tick_part_seconds_total", "Time of ticks by the part of the server that took it.",
               report.part_sums[part] / ms_per_s, label("part", name_of(part)));
  for (const TickStageRow& row : tick_stages)
    page.durations("scree_tick_stage_duration_seconds",
                   "Stages of the world's ticks; some count only in ticks in which they changed something.",
                   report.stages[index_of(row.stage)], stage_bounds_s, label("stage", row.name));
  for (const TickStageRow& row : tick_stages)
    page.total("scree_tick_stage_modelled_seconds_total",
               "Work of the stages, as the server's model estimates it.",
               report.stage_sums.model_ms[index_of(row.stage)] / ms_per_s, label("stage", row.name));
  const char* const late = "Ticks that ended after the next one was due, by what took longest.";
  totals(page, "scree_late_ticks_total", late, "cause",
         {std::pair{"earlier", report.late.earlier}, std::pair{"waiting", report.late.waiting}});
  for (const TickPart part : all_kinds<TickPart>)
    page.total("scree_late_ticks_total", late,
               static_cast<double>(report.late.by_part[static_cast<size_t>(part)]),
               label("cause", name_of(part)));
  page.total("scree_lost_ticks_total", "Ticks of real time that were not made up for.",
             static_cast<double>(report.overruns));
}

void add_work(FigurePage& page, const ServerReport& report) {
  const TickWork& now = report.last_work;
  states<uint32_t>(page, "scree_work_waiting", "Work that the last tick put off, in pieces of its kind.",
                   "work",
                   {{"requests", now.requests_waiting},
                    {"cuts", now.refractures_put_off},
                    {"merges", now.merges_put_off},
                    {"supports", now.supports_put_off},
                    {"islands", now.islands_put_off},
                    {"slides", now.slides_put_off}});
  totals<uint64_t>(page, "scree_work_left_out_total", "Work that ticks left out, because it did not fit.",
                   "work",
                   {{"breaks", report.work.breaks_left_out},
                    {"dents", report.work.dents_left_out},
                    {"blows", report.work.blows_left_out},
                    {"supports", report.work.supports_given_up},
                    {"islands", report.work.islands_too_large}});
  page.total("scree_ticks_cut_short_total", "Ticks that put any work off, or left it out.",
             static_cast<double>(report.work.ticks_cut_short));
  page.total("scree_ticks_merging_sooner_total", "Ticks in which a crowd of pieces merged sooner.",
             static_cast<double>(report.work.ticks_merging_sooner));
  page.state("scree_work_ratio", "The setting work-percent, as a ratio.",
             number_of(report.settings, "work-percent") / 1e2);
  page.total("scree_requests_total", "Requests that came from clients.",
             static_cast<double>(report.net.requests));
  totals<uint64_t>(page, "scree_requests_answered_total", "Requests that ticks answered.", "answer",
                   {{"granted", report.requests_granted}, {"refused", report.requests_refused}});
  page.state("scree_requests_held", "Requests that wait for terrain to be read.",
             static_cast<double>(report.requests_held));
  for (size_t i = 0; i < refusal_reasons; ++i) {
    const auto reason = static_cast<Refusal>(i);
    page.total("scree_refusals_total", "Requests, questions, sessions and connections that were refused.",
               static_cast<double>(report.net.refusals.of(reason)), label("reason", name_of(reason)));
  }
}

void add_world(FigurePage& page, const ServerReport& report, const MetricsFacts& more) {
  report.operations.for_each([&](std::string_view name, uint64_t count) {
    page.total("scree_operations_total", "Changes of the terrain.", static_cast<double>(count),
               label("kind", name));
  });
  page.state("scree_pieces", "Pieces alive.", static_cast<double>(report.pieces_alive));
  page.state("scree_pieces_kept", "Those of them that are kept, and never merge.",
             static_cast<double>(report.kept));
  page.state("scree_pieces_max", "The setting pieces-max.", number_of(report.settings, "pieces-max"));
  page.total("scree_pieces_made_total", "Pieces that were made.", static_cast<double>(report.pieces_made));
  page.total("scree_pieces_merged_total", "Pieces that became terrain again.",
             static_cast<double>(report.pieces_merged));
  page.state("scree_props", "Props.", static_cast<double>(report.props));
  page.state("scree_persons", "Persons on foot.", static_cast<double>(report.persons));
  const double m3 =
      static_cast<double>(more.voxel_size_m) * more.voxel_size_m * more.voxel_size_m / units_per_voxel;
  const Ledger& ledger = report.ledger;
  states<double>(page, "scree_ledger_cubic_meters",
                 "Where the mass is, as cubic metres of a material of density 1.", "place",
                 {{"terrain", m3 * static_cast<double>(ledger.terrain)},
                  {"pieces", m3 * static_cast<double>(ledger.pieces)},
                  {"dust", m3 * static_cast<double>(ledger.dust)},
                  {"stores", m3 * static_cast<double>(ledger.stored)},
                  {"poured", m3 * static_cast<double>(ledger.poured)},
                  {"moved", m3 * static_cast<double>(ledger.moved)}});
  page.state("scree_ledger_error_cubic_meters", "Mass that came from nowhere, or went there: always 0.",
             m3 * static_cast<double>(ledger.error()));
  states<uint32_t>(page, "scree_chunks", "Edited chunks of the terrain, by where they are.", "place",
                   {{"memory", report.paging.chunks_in}, {"file", report.paging.chunks_out}});
  page.total("scree_chunks_read_total", "Chunks that were read from the world's file.",
             static_cast<double>(report.paging.chunks_read));
  page.total("scree_chunk_waits_total", "Times that a tick waited for a chunk.",
             static_cast<double>(report.paging.waits));
}

void add_sessions(FigurePage& page, const NetFigures& figures) {
  const NetStats& net = figures.stats;
  std::array<uint64_t, kind_count<Role>> by_role{};
  for (const SessionRow& row : figures.sessions) ++by_role[static_cast<size_t>(row.role)];
  for (const Role role : all_kinds<Role>)
    page.state("scree_sessions", "Sessions that have joined.",
               static_cast<double>(by_role[static_cast<size_t>(role)]), label("role", name_of(role)));
  page.state("scree_sessions_max", "The setting sessions-max, as far as the process may open files.",
             figures.stats.sessions_max);
  totals<uint64_t>(page, "scree_joins_total", "Sessions that joined; resumed ones went on by a ticket.",
                   "how",
                   {{"new", net.sessions_joined - net.sessions_resumed}, {"resumed", net.sessions_resumed}});
  totals<uint64_t>(page, "scree_sessions_ended_total", "Sessions and connections that the server ended.",
                   "how",
                   {{"refused", net.sessions_refused},
                    {"cut_off", net.sessions_disconnected},
                    {"turned_away", net.turned_away}});
  page.total("scree_tickets_void_total", "Tickets of lost sessions that did not hold.",
             static_cast<double>(net.tickets_void));
  page.state("scree_sessions_behind", "Sessions whose link takes less than there is for them.",
             static_cast<double>(figures.sessions_behind));
  page.total("scree_session_resets_total", "Sessions that fell behind, and began anew.",
             static_cast<double>(net.published.resets));
  page.total("scree_chunk_repairs_total", "Chunks that were sent again, because a client's differed.",
             static_cast<double>(net.published.repairs));
}

template <typename Counts, typename Kinds>
void add_messages(FigurePage& page, const char* name, const char* help, const char* direction,
                  const Counts& counts, const Kinds& kinds, uint64_t MessageCount::*count) {
  for (size_t kind = 0; kind < kinds.size(); ++kind)
    page.total(name, help, static_cast<double>(counts[kind].*count),
               {{"direction", direction}, {"kind", std::string(kinds[kind].name)}});
}

void add_network(FigurePage& page, const NetFigures& figures) {
  const NetStats& net = figures.stats;
  const auto add = [&](const char* name, const char* help, uint64_t MessageCount::*count) {
    add_messages(page, name, help, "out", figures.messages.out, server_message_kinds, count);
    add_messages(page, name, help, "in", figures.messages.in, client_message_kinds, count);
  };
  add("scree_messages_total", "Messages of sessions.", &MessageCount::messages);
  add("scree_message_bytes_total", "Bytes of the messages, before TLS.", &MessageCount::bytes);
  page.total("scree_sent_bytes_total", "Bytes to sessions and by HTTP.", static_cast<double>(net.bytes_out));
  page.total("scree_sent_held_total", "Times that a session or a connection had used up its bytes.",
             static_cast<double>(net.bytes_out_held));
  page.state("scree_unsent_bytes", "Bytes that wait for clients.", static_cast<double>(figures.unsent_bytes));
  page.total("scree_publish_waits_total", "Times that the simulation waited for the network's thread.",
             static_cast<double>(net.publish_waits));
  page.durations("scree_frame_age_seconds",
                 "From the end of a tick until a client's socket is given its frame.", figures.frame_age,
                 wait_bounds_s);
  for (size_t stage = 0; stage < latency_stages.size(); ++stage)
    page.durations("scree_request_duration_seconds",
                   "Requests that a tick answered, by the stages of their way.", figures.latency[stage],
                   wait_bounds_s, label("stage", latency_stages[stage].name));
  page.state("scree_http_connections", "Connections that speak HTTP.", net.web.connections);
  page.total("scree_http_requests_total", "Requests by HTTP.", static_cast<double>(net.web.requests));
  page.total("scree_http_sent_bytes_total", "Bytes of the answers to these.",
             static_cast<double>(net.web.bytes_sent));
  page.total("scree_websockets_total", "WebSockets that were opened.",
             static_cast<double>(net.web.websockets));
}

void add_saving(FigurePage& page, const ServerReport& report, const ServerFacts& facts) {
  if (report.world_path.empty()) return;
  const SaverStatus& saving = report.saving;
  page.state("scree_saving_failing", "1 while the world's file cannot be written, else 0.",
             saving.health.ok() ? 0 : 1);
  page.state("scree_unsaved_seconds", "How far the world is ahead of its file.",
             static_cast<double>(report.last_tick - std::min(report.last_tick, saving.saved_tick)) /
                 facts.tick_rate_hz);
  page.state("scree_unsaved_chunks", "Chunks that changed, and are in no save yet.",
             static_cast<double>(saving.unsaved_chunks));
  page.state("scree_saves_waiting", "Saves that wait while another is written: 0 or 1.",
             saving.save_waits ? 1 : 0);
  page.durations("scree_save_duration_seconds", "Saves, failed ones too.", report.saves, disk_bounds_s);
  page.total("scree_save_failures_total", "Saves that failed.", static_cast<double>(saving.failures));
  page.total("scree_saves_skipped_total", "Saves that were due while another one waited.",
             static_cast<double>(saving.skipped));
  page.total("scree_saved_bytes_total", "Bytes of the rows that were saved.",
             static_cast<double>(saving.bytes_written));
}

void add_recording(FigurePage& page, const ServerReport& report) {
  if (!report.record_path.empty()) {
    const RecordingSize& size = report.record_size;
    page.state("scree_recording_failing", "1 while the recording cannot be written, else 0.",
               report.recording.ok() ? 0 : 1);
    page.total("scree_recorded_ticks_total", "Ticks that were recorded.",
               static_cast<double>(report.ticks_recorded));
    page.total("scree_recording_lost_ticks_total", "Ticks that no part of the recording has.",
               static_cast<double>(report.recording.lost));
    page.state("scree_recording_waiting_ticks", "Ticks that wait to be recorded.",
               static_cast<double>(report.record_waiting));
    page.total("scree_recording_waits_total", "Times that a tick waited for the recording.",
               static_cast<double>(report.record_waits));
    page.durations("scree_recording_commit_duration_seconds", "Commits of the recording, failed ones too.",
                   report.record_commits, disk_bounds_s);
    page.state("scree_recording_bytes", "What the recording's last part takes on the disk.",
               static_cast<double>(size.bytes()));
  }
  if (!report.events_path.empty()) {
    page.state("scree_events_failing", "1 while the log of events cannot be written, else 0.",
               report.events.health.ok() ? 0 : 1);
    page.total("scree_events_written_total", "Lines of the log of events.",
               static_cast<double>(report.events.written));
    page.total("scree_events_lost_total", "Lines that it has not.",
               static_cast<double>(report.events.health.lost));
  }
  if (const auto& history = report.history) {
    page.state("scree_history_failing", "1 while the history of edits cannot be written, else 0.",
               history->health.ok() ? 0 : 1);
    page.total("scree_history_edits_total", "Edits that the history was told of.",
               static_cast<double>(history->edits));
    page.total("scree_history_lost_ticks_total", "Ticks whose edits it has not.",
               static_cast<double>(history->health.lost));
    page.state("scree_history_bytes", "What the history takes on the disk.",
               static_cast<double>(history->bytes));
  }
  const auto disk = [&](std::string_view file, uint64_t free_bytes) {
    if (free_bytes != 0)
      page.state("scree_disk_free_bytes", "Room where a file lies, after it was last written.",
                 static_cast<double>(free_bytes), label("file", file));
  };
  if (!report.world_path.empty()) disk("world", report.saving.disk_free_bytes);
  if (!report.record_path.empty()) disk("recording", report.record_size.disk_free_bytes);
}

}  // namespace

std::string metrics_text(const ServerReport& report, const NetFigures& figures, const ServerFacts& facts,
                         const MetricsFacts& more) {
  FigurePage page;
  add_process(page, report, figures, facts, more);
  add_ticks(page, report, facts);
  add_work(page, report);
  add_world(page, report, more);
  add_sessions(page, figures);
  add_network(page, figures);
  add_saving(page, report, facts);
  add_recording(page, report);
  for (const Figure& figure : more.of_host) page.add(figure);
  return page.text();
}

}  // namespace scree
