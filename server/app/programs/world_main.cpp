// scree-world: describes, checks, copies, repairs and compacts the file of a world. Exit status: 0 success, 1
// failure or damage, 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "server/store/world_file.h"
#include "server/store/world_lock.h"
#include "server/world/recorded_values.h"
#include "server/world/settings.h"
#include "server/world/world.h"

namespace scree {
namespace {

constexpr int failed = 1;
constexpr int usage_error = 2;

using Json = nlohmann::ordered_json;

struct Options {
  std::string path;
  std::string to;
  bool json = false;
};

std::string hex(uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
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

int complain(const Error& error) {
  std::fprintf(stderr, "scree-world: error: %s\n", error.message.c_str());
  return failed;
}

Json describe(const std::string& path, const WorldRows& rows) {
  const WorldMoment& moment = rows.world.moment;
  Json settings = Json::object();
  for (const SettingValue& setting : moment.config.settings) settings[setting.name] = setting.value;
  size_t waiting = 0;
  for (const PartyValue& party : moment.requests.parties)
    for (const SessionValue& session : party.sessions) waiting += session.requests.size();
  std::error_code ignored;
  return {{"file", path},
          {"format", world_format},
          {"made_by", rows.header.config.program},
          {"terrain", std::string(name_of(moment.config.terrain.kind))},
          {"seed", moment.config.terrain.random_seed},
          {"voxel_size_m", moment.config.terrain.voxel_size_m},
          {"tick_rate_hz", moment.config.tick_rate_hz},
          {"settings", std::move(settings)},
          {"tick", moment.tick},
          {"seconds", static_cast<double>(moment.tick) / moment.config.tick_rate_hz},
          {"chunks_edited", rows.chunks.size()},
          {"bricks_edited", rows.world.bricks.size()},
          {"pieces_alive", moment.pieces.size()},
          {"requests_waiting", waiting},
          {"ledger_error", from_recorded(moment.ledger).error()},
          {"field_hash", hex(moment.field_hash)},
          {"state_hash", hex(moment.state_hash)},
          {"bytes_of_rows", rows.bytes},
          {"bytes", std::filesystem::file_size(path, ignored)}};
}

int info(const Options& options) {
  const auto file = WorldFile::open(options.path);
  if (!file) return complain(file.error());
  const auto rows = (*file)->read();
  if (!rows) return complain(rows.error());
  print(describe(options.path, *rows), options.json);
  return 0;
}

/// Everything that a server's start checks.
int check(const Options& options) {
  const auto reason = [&]() -> std::string {
    const auto file = WorldFile::open(options.path);
    if (!file) return file.error().message;
    const auto rows = (*file)->read();
    if (!rows) return rows.error().message;
    const auto world = World::restore(rows->world);
    return world ? std::string() : options.path + ": damaged: " + world.error().message;
  }();
  Json json{{"file", options.path}, {"whole", reason.empty()}};
  if (!reason.empty()) json["damage"] = reason;
  print(json, options.json);
  return reason.empty() ? 0 : failed;
}

int backup(const Options& options) {
  const auto file = WorldFile::open(options.path);
  if (!file) return complain(file.error());
  if (const auto copied = (*file)->copy_to(options.to); !copied) return complain(copied.error());
  return check({options.to, {}, options.json});
}

/// Keeps what is whole in a new file; the damaged one stays as it is.
int repair(const Options& options) {
  const auto lock = WorldLock::take(options.path);
  if (!lock) return complain(lock.error());
  const auto file = WorldFile::open(options.path);
  if (!file) return complain(file.error());
  LostRows lost;
  const auto rows = (*file)->read(&lost);
  if (!rows) return complain(rows.error());
  auto world = World::salvage(rows->world);
  if (!world) return complain(world.error());
  const WorldSnapshot value = (*world)->snapshot();
  const auto made = WorldFile::create(options.to, rows->header, value);
  if (!made) return complain(made.error());
  const WorldMoment& before = rows->world.moment;
  print({{"file", options.path},
         {"repaired", options.to},
         {"lost", lost.reasons},
         {"chunks_kept", rows->chunks.size()},
         {"pieces_kept", value.moment.pieces.size()},
         {"pieces_lost", before.motion.bodies.size() - value.moment.pieces.size()},
         {"terrain_lost_units", before.ledger.terrain - value.moment.ledger.terrain}},
        options.json);
  return 0;
}

int compact(const Options& options) {
  const auto lock = WorldLock::take(options.path);
  if (!lock) return complain(lock.error());
  std::error_code ignored;
  const auto before = std::filesystem::file_size(options.path, ignored);
  {
    const auto file = WorldFile::open(options.path);
    if (!file) return complain(file.error());
    if (const auto whole = (*file)->read(); !whole) return complain(whole.error());
    if (const auto done = (*file)->compact(); !done) return complain(done.error());
  }
  print({{"file", options.path},
         {"bytes_before", before},
         {"bytes", std::filesystem::file_size(options.path, ignored)}},
        options.json);
  return 0;
}

CLI::App* add_command(CLI::App& app, Options& options, const char* name, const char* what) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("FILE", options.path, "the file of a world")->required();
  command->add_flag("--json", options.json, "prints JSON");
  return command;
}

int run(int argc, char** argv) {
  CLI::App app("Looks after the file that keeps a world (scree-server --world).", "scree-world");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(1);
  Options options;
  const std::pair<CLI::App*, int (*)(const Options&)> commands[] = {
      {add_command(app, options, "info", "says what it holds; also while a server runs"), info},
      {add_command(app, options, "check", "checks all that a server's start does; also while a server runs"),
       check},
      {add_command(app, options, "backup", "copies it as of one moment; also while a server runs"), backup},
      {add_command(app, options, "repair", "keeps in a new file all that is whole, and says what was lost"),
       repair},
      {add_command(app, options, "compact", "gives room back"), compact}};
  for (const size_t with_new : {2U, 3U})
    commands[with_new].first->add_option("NEW", options.to, "the new file")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  for (const auto& [command, act] : commands)
    if (command->parsed()) return act(options);
  return usage_error;
}

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  return scree::run(argc, argv);
}
