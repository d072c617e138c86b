// scree-replay: describes a recording, verifies it by simulating it again, exports what it says, compares it
// with another one, and cuts a shorter one out of it. Exit status: 0 success; 1 failure, or a difference; 2
// wrong usage; of diff, as diff(1): 0 the same, 1 different, 2 trouble.
#include <CLI/CLI.hpp>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "content/builtin_palette.h"
#include "ground/whole_file.h"
#include "server/app/ground_giver.h"
#include "server/app/world_facts.h"
#include "server/replay/export_lines.h"
#include "server/replay/recorded_moment.h"
#include "server/replay/recording_diff.h"
#include "server/replay/recording_excerpt.h"
#include "server/replay/request_lines.h"
#include "server/replay/verify.h"
#include "server/store/recording_reader.h"
#include "server/world/settings.h"
#include "shared/base/distinct_files.h"
#include "shared/base/option_check.h"
#include "shared/base/program_output.h"
#include "shared/base/progress_bar.h"
#include "shared/operation/per_operation.h"

namespace scree {
namespace {

constexpr int differs_or_failed = 1;
constexpr int usage_error = 2;

using Json = nlohmann::ordered_json;

struct Options {
  std::string path;
  std::string ground;
  bool json = false;
  bool csv = false;
  std::string events_path;
  std::string ticks_path;
  std::string requests_path;
  std::string other;  ///< recording to compare with
  std::string to_path;
  std::string first, last;  ///< ticks or times
};

std::string hex(uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

int complain(const Error& error) {
  std::fprintf(stderr, "scree-replay: error: %s\n", error.message.c_str());
  return differs_or_failed;
}

void print(const Json& json, bool as_json) {
  if (as_json) {
    std::printf("%s\n", json.dump(2).c_str());
    return;
  }
  for (const auto& [name, value] : json.items()) {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    std::printf("%-18s %s\n", name.c_str(), text.c_str());
  }
}

/// Counts over all frames and commands of a recording.
struct Sums {
  uint64_t commands = 0, merges = 0;
  OperationCounts operations;
  RecordedFrame last;
};

Result<Sums> sum_up(RecordingReader& recording) {
  Sums sums;
  for (Tick tick = recording.first_tick(); tick <= recording.last_tick(); ++tick) {
    auto frame = recording.frame(tick);
    TRY(frame);
    const auto commands = recording.commands(tick);
    TRY(commands);
    sums.commands += commands->size();
    for (const Operation& operation : frame->operations) {
      ++sums.operations[operation];
      sums.merges += pieces_merged_by(operation);
    }
    sums.last = std::move(*frame);
  }
  return sums;
}

/// By kind; nothing where there is no log of events.
Result<Json> count_events(RecordingReader& recording) {
  if (!recording.events_from()) return Json();
  std::array<uint64_t, kind_count<EventKind>> counts{};
  const auto count = [&](const std::vector<Event>& events) {
    for (const Event& event : events) ++counts[static_cast<size_t>(event.kind)];
  };
  const auto events = recording.events(recording.first_tick(), recording.last_tick());
  TRY(events);
  count(*events);
  const auto rows = TRY(recording.machine(recording.first_tick(), recording.last_tick()));
  for (const RecordedMachine& row : rows) count(row.events);
  Json json = Json::object();
  for (const EventKind kind : all_kinds<EventKind>)
    if (const uint64_t n = counts[static_cast<size_t>(kind)]; n > 0) json[std::string(name_of(kind))] = n;
  return json;
}

int info(const Options& options) {
  const auto recording = RecordingReader::open(options.path);
  if (!recording) return complain(recording.error());
  const auto sums = sum_up(**recording);
  if (!sums) return complain(sums.error());
  const auto events = count_events(**recording);
  if (!events) return complain(events.error());
  const RecordingHeader& header = (*recording)->header();
  const WorldConfig& world = header.world;
  const Tick first = (*recording)->first_tick();
  const Tick ticks = (*recording)->last_tick() - first + 1;
  const Ledger ledger = sums->last.ledger;
  Json settings = Json::object();
  for (const SettingValue& setting : print(world)) settings[setting.name] = setting.value;
  const bool is_builtin = world.palette == nullptr || *world.palette == builtin_palette();
  const Palette* const own_palette = is_builtin ? nullptr : world.palette.get();
  Json json{{"file", options.path},
            {"format", recording_format},
            {"recorded_by", header.program},
            {"terrain", terrain_text(world.ground, world.terrain)},
            {"seed", world.terrain.random_seed},
            {"voxel_size_m", world.terrain.voxel_size_m},
            {"tick_rate_hz", world.tick_rate_hz},
            {"materials", Json::parse(palette_facts(own_palette))},
            {"settings", settings},
            {"first_tick", first},
            {"ticks", ticks},
            {"seconds", static_cast<double>(ticks) / world.tick_rate_hz},
            {"ended", (*recording)->is_ended()},
            {"keyframes", (*recording)->keyframes()},
            {"events", *events},
            {"commands", sums->commands}};
  sums->operations.for_each([&](std::string_view name, uint64_t count) { json[std::string(name)] = count; });
  json.update({{"merges", sums->merges},
               {"ledger_error", ledger.error()},
               {"field_hash", hex(sums->last.field_hash)},
               {"state_hash", hex(sums->last.state_hash)},
               {"bytes", (*recording)->bytes()}});
  if ((*recording)->may_lack_ticks())
    json["log_missing"] =
        options.path +
        "-wal is not beside it: if it was copied while it was being written, its last ticks are "
        "missing";
  print(json, options.json);
  return 0;
}

int verify_file(const Options& options) {
  const auto recording = RecordingReader::open(options.path);
  if (!recording) return complain(recording.error());
  const auto ground = ground_giver(options.path, options.ground);
  if (!ground) return complain(ground.error());
  ProgressBar bar(isatty(STDERR_FILENO) != 0);
  const auto report = verify(
      **recording,
      [&](Tick done, Tick all) { bar.show(static_cast<double>(done) / static_cast<double>(all)); }, *ground);
  bar.end();
  if (!report) return complain(report.error());
  Json json{{"file", options.path},
            {"agrees", report->agrees()},
            {"ticks", report->ticks},
            {"ticks_recorded", (*recording)->last_tick() - (*recording)->first_tick() + 1},
            {"commands", report->commands},
            {"events", report->events},
            {"restarts", report->restarts},
            {"field_hash", hex(report->field_hash)},
            {"state_hash", hex(report->state_hash)},
            {"seconds", report->seconds}};
  if (!report->agrees()) {
    json["first_difference"] = report->first_difference;
    json["difference"] = report->difference;
  }
  print(json, options.json);
  return report->agrees() ? 0 : differs_or_failed;
}

using WriteLines = std::function<Result<void>(const LineSink&)>;

Result<void> write_lines_to(std::FILE* file, const std::string& path, const WriteLines& write) {
  auto written = write([file](const std::string& line) { std::fprintf(file, "%s\n", line.c_str()); });
  if (std::fflush(file) != 0 || std::ferror(file) != 0)
    return fail(path + " cannot be written: " + std::strerror(errno));
  return written;
}

/// Writes lines to the standard output ("-"), or to a file, which has its name when it is whole.
Result<void> write_lines(const std::string& path, const WriteLines& write) {
  if (path == "-") return write_lines_to(stdout, path, write);
  const auto written = write_whole(path, [&](const std::string& unfinished) -> Result<void> {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(unfinished.c_str(), "w"),
                                                               std::fclose);
    if (file == nullptr) return fail(std::strerror(errno));
    return write_lines_to(file.get(), path, write);
  });
  TRY(written);
  return {};
}

int export_lines(const Options& options) {
  if (!options.events_path.empty() || !options.ticks_path.empty() || !options.requests_path.empty()) {
    const std::array files{NamedFile{"the recording", options.path, false, true},
                           NamedFile{"--events", options.events_path, options.events_path != "-"},
                           NamedFile{"--ticks", options.ticks_path, options.ticks_path != "-"},
                           NamedFile{"--requests", options.requests_path, options.requests_path != "-"}};
    if (const auto distinct = check_distinct(files); !distinct) return complain(distinct.error());
  }
  const auto ground = ground_giver(options.path, options.ground);
  if (!ground) return complain(ground.error());
  const auto format_of = [&](const std::string& path) {
    return options.csv || path.ends_with(".csv") ? LineFormat::csv : LineFormat::jsonl;
  };
  if (!options.events_path.empty()) {
    const auto written = write_lines(options.events_path, [&](const LineSink& write_line) {
      return export_events(options.path, *ground, format_of(options.events_path), write_line);
    });
    if (!written) return complain(written.error());
  }
  if (options.ticks_path.empty() && options.requests_path.empty()) return 0;
  const auto recording = RecordingReader::open(options.path);
  if (!recording) return complain(recording.error());
  const auto export_to = [&](const std::string& path, auto* write_all) -> Result<void> {
    if (path.empty()) return {};
    return write_lines(path, [&](const LineSink& write_line) {
      return write_all(**recording, format_of(path), write_line);
    });
  };
  if (const auto written = export_to(options.ticks_path, &export_ticks); !written)
    return complain(written.error());
  if (const auto written = export_to(options.requests_path, &export_requests); !written)
    return complain(written.error());
  return 0;
}

int diff_files(const Options& options) {
  constexpr int trouble = 2;
  const auto ground = ground_giver(options.path, options.ground);
  const auto other_ground = ground_giver(options.other, options.ground);
  for (const auto* given : {&ground, &other_ground})
    if (!*given) return static_cast<void>(complain(given->error())), trouble;
  ProgressBar bar(isatty(STDERR_FILENO) != 0);
  const auto found = diff({options.path, *ground}, {options.other, *other_ground}, [&](Tick done, Tick all) {
    bar.show(static_cast<double>(done) / static_cast<double>(all));
  });
  bar.end();
  if (!found) return static_cast<void>(complain(found.error())), trouble;
  Json json{{"file", options.path},
            {"other", options.other},
            {"same", found->same()},
            {"first_tick", found->first},
            {"last_tick", found->last}};
  if (!found->same()) json["first_difference"] = found->tick;
  for (const StageDifference& stage : found->stages) json[std::string(name_of(stage.stage))] = stage.text;
  print(json, options.json);
  return found->same() ? 0 : differs_or_failed;
}

int write_excerpt_file(const Options& options) {
  const auto recording = RecordingReader::open(options.path);
  if (!recording) return complain(recording.error());
  const auto ground = ground_giver(options.path, options.ground);
  if (!ground) return complain(ground.error());
  const uint32_t rate_hz = (*recording)->header().world.tick_rate_hz;
  Tick first = (*recording)->first_tick(), last = (*recording)->last_tick();
  if (!options.first.empty()) {
    const auto moment = parse_tick_or_time(options.first);
    if (!moment) return complain({moment.error().message + " (--from)"});
    if (const Tick tick = moment->nearest_tick(rate_hz); tick != 0) first = tick;
  }
  if (!options.last.empty()) {
    const auto moment = parse_tick_or_time(options.last);
    if (!moment) return complain({moment.error().message + " (--to)"});
    last = moment->nearest_tick(rate_hz);
  }
  ProgressBar bar(isatty(STDERR_FILENO) != 0);
  const auto report =
      write_excerpt(**recording, options.to_path, first, last, *ground, [&](double part) { bar.show(part); });
  bar.end();
  if (!report) return complain(report.error());
  print(Json{{"file", options.to_path},
             {"first_tick", report->first},
             {"ticks", report->last - report->first + 1},
             {"state_of_tick", report->state},
             {"bytes", report->bytes}},
        options.json);
  return 0;
}

CLI::App* add_command(CLI::App& app, Options& options, const char* name, const char* what) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("FILE", options.path, "a recording")->required();
  return command;
}

void add_ground(CLI::App* command, Options& options) {
  command->add_option("--ground", options.ground, "its ground file; default: found in the same folder");
}

using Run = int (*)(const Options&);

/// A row each: what to run when the subcommand was given.
std::vector<std::pair<const CLI::App*, Run>> add_commands(CLI::App& app, Options& options) {
  CLI::App* info_command = add_command(app, options, "info", "describes a recording");
  CLI::App* verify_command =
      add_command(app, options, "verify",
                  "simulates it again from the commands, and compares every tick's hash and events");
  CLI::App* diff_command = add_command(app, options, "diff",
                                       "finds the first tick in which two recordings differ, with the stage "
                                       "and the place; exit status 0: they are the same");
  diff_command->add_option("OTHER", options.other, "another recording")->required();
  CLI::App* cut_command =
      add_command(app, options, "cut", "makes a shorter recording, which plays and verifies by itself");
  cut_command->add_option("OUT", options.to_path, "the new file")->required();
  cut_command->add_option("--from", options.first, "its first tick, or a time: 90s, 1.5m, 1:30");
  cut_command->add_option("--to", options.last, "its last tick, or a time");
  for (CLI::App* command : {info_command, verify_command, diff_command, cut_command})
    command->add_flag("--json", options.json, "prints JSON");
  CLI::App* events = add_command(app, options, "events", "prints the events, one a line (JSON Lines)");
  events->add_flag("--csv", options.csv, "prints CSV");
  CLI::App* requests =
      add_command(app, options, "requests", "prints the requests and who sent them, one a line (JSON Lines)");
  requests->add_flag("--csv", options.csv, "prints CSV");
  CLI::App* exported =
      add_command(app, options, "export",
                  "writes events, requests and ticks as JSON Lines, or as CSV if the name ends in .csv");
  exported->add_option("--events", options.events_path, "file for the events; -: the standard output");
  exported->add_option("--ticks", options.ticks_path,
                       "file for every tick's duration and ledger; -: the standard output");
  exported->add_option("--requests", options.requests_path,
                       "file for every request and its sender; -: the standard output");
  exported->require_option(1, 0);
  for (CLI::App* command : {verify_command, events, exported, diff_command, cut_command})
    add_ground(command, options);
  for (CLI::App* command :
       {info_command, verify_command, events, requests, exported, diff_command, cut_command})
    refuse_empty(*command);
  return {{info_command, info},
          {verify_command, verify_file},
          {diff_command, diff_files},
          {cut_command, write_excerpt_file},
          {events,
           [](const Options& o) {
             Options to_screen = o;
             to_screen.events_path = "-";
             return export_lines(to_screen);
           }},
          {requests,
           [](const Options& o) {
             Options to_screen = o;
             to_screen.requests_path = "-";
             return export_lines(to_screen);
           }},
          {exported, export_lines}};
}

int run(int argc, char** argv) {
  CLI::App app("Describes, verifies, compares and shortens recordings of scree-server.", "scree-replay");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(1);
  Options options;
  const auto commands = add_commands(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  for (const auto& [command, run_command] : commands) {
    if (!command->parsed()) continue;
    const int code = run_command(options);
    const auto printed = flush_output();
    return code == 0 && !printed ? complain(printed.error()) : code;
  }
  return usage_error;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  scree::fail_at_file_limit();
  return scree::run(argc, argv);
}
