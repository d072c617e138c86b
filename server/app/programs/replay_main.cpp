// scree-replay: describes a recording, and verifies it by simulating it again.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "server/app/ground_giver.h"
#include "server/replay/verify.h"
#include "server/store/recording_reader.h"
#include "server/world/settings.h"
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
    if (!frame) return tl::unexpected(frame.error());
    const auto commands = recording.commands(tick);
    if (!commands) return tl::unexpected(commands.error());
    sums.commands += commands->size();
    for (const Operation& operation : frame->operations) {
      ++sums.operations[operation];
      sums.merges += pieces_merged_by(operation);
    }
    sums.last = std::move(*frame);
  }
  return sums;
}

int info(const Options& options) {
  const auto recording = RecordingReader::open(options.path);
  if (!recording) return complain(recording.error());
  const auto sums = sum_up(**recording);
  if (!sums) return complain(sums.error());
  const RecordingHeader& header = (*recording)->header();
  const WorldConfig& world = header.world;
  const Tick first = (*recording)->first_tick();
  const Tick ticks = (*recording)->last_tick() - first + 1;
  const Ledger ledger = from_recorded(sums->last.ledger);
  Json settings = Json::object();
  for (const SettingValue& setting : print(world)) settings[setting.name] = setting.value;
  Json json{{"file", options.path},
            {"format", recording_format},
            {"recorded_by", header.program},
            {"terrain", terrain_text(world.ground, world.terrain)},
            {"seed", world.terrain.random_seed},
            {"voxel_size_m", world.terrain.voxel_size_m},
            {"tick_rate_hz", world.tick_rate_hz},
            {"settings", settings},
            {"first_tick", first},
            {"ticks", ticks},
            {"seconds", static_cast<double>(ticks) / world.tick_rate_hz},
            {"keyframes", (*recording)->keyframes()},
            {"commands", sums->commands}};
  sums->operations.for_each([&](std::string_view name, uint64_t count) { json[std::string(name)] = count; });
  json.update({{"merges", sums->merges},
               {"ledger_error", ledger.error()},
               {"field_hash", hex(sums->last.field_hash)},
               {"state_hash", hex(sums->last.state_hash)},
               {"bytes", (*recording)->bytes()}});
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

CLI::App* add_command(CLI::App& app, Options& options, const char* name, const char* what) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("FILE", options.path, "a recording")->required();
  command->add_flag("--json", options.json, "prints JSON");
  return command;
}

int run(int argc, char** argv) {
  CLI::App app("Looks at recordings of scree-server.", "scree-replay");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(1);
  Options options;
  const CLI::App* info_command = add_command(app, options, "info", "says what a recording holds");
  add_command(app, options, "verify", "simulates it again from the commands, and compares every tick's hash")
      ->add_option("--ground", options.ground, "its ground file, where that does not lie beside it");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  return info_command->parsed() ? info(options) : verify_file(options);
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  return scree::run(argc, argv);
}
