#include "server/app/server_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <fmt/format.h>
#include <limits>
#include <sstream>
#include <string_view>
#include <unistd.h>

#include "proto/messages.h"
#include "server/app/agones_options.h"
#include "server/app/backup_options.h"
#include "server/app/config_file.h"
#include "server/app/door_options.h"
#include "server/app/environment.h"
#include "server/app/flight_options.h"
#include "server/app/ground_giver.h"
#include "server/app/limits.h"
#include "server/app/log_options.h"
#include "server/app/option_sources.h"
#include "server/app/option_variables.h"
#include "server/app/rules_options.h"
#include "server/app/web_folder.h"
#include "server/app/world_materials.h"
#include "server/web/site.h"
#include "server/world/limits.h"
#include "server/world/settings.h"
#include "shared/base/distinct_files.h"
#include "shared/base/limits.h"
#include "shared/base/listed.h"
#include "shared/base/near_name.h"
#include "shared/base/option_check.h"
#include "shared/base/preset.h"
#include "shared/base/workers.h"

namespace scree {

namespace {

constexpr int usage_error = 2;

struct Raw {
  ServerOptions options;
  std::string preset;  ///< empty: none
  DoorOptions doors;
  RulesFlags rules;
  std::string durability = "second";
  std::string ground;     ///< empty: generated
  std::string materials;  ///< file of a palette; empty: the built-in one, or a kept world's
  std::string models;     ///< folder of the models of props; empty: none
  std::string web;        ///< empty: the folder beside the program
  bool loop = false;      ///< of a replay
  bool end = false;
  std::string terrain = std::string(name_of(TerrainSource{}.kind));
};

void add_threads(CLI::App& app, const char* name, size_t& threads, const std::string& what) {
  bounded(app.add_option(name, threads, "threads that " + what + "; 0: one for each core"),
          whole_within(0, static_cast<double>(Workers::threads_max)))
      ->capture_default_str();
}

template <typename Kind>
std::vector<std::string> names_of_kind() {
  return {kind_names<Kind>.begin(), kind_names<Kind>.end()};
}

void add_preset(CLI::App& app, Raw& raw) {
  app.add_option("--preset", raw.preset,
                 "values for a kind of machine; options that you give override them:\n" +
                     describe_presets(all_kinds<Preset>, server_preset_options))
      ->check(CLI::IsMember(names_of_kind<Preset>()));
}

void add_network(CLI::App& app, Raw& raw) {
  NetConfig& net = raw.options.live.net;
  net.port = default_port;
  bounded(app.add_option("-p,--port", net.port, "TCP port; 0: any free port"), whole_within(0, 65535))
      ->capture_default_str();
  app.add_option("--bind,--host", net.bind, "address to listen on; 0.0.0.0: all addresses of this machine")
      ->capture_default_str();
  app.add_option("--chat", net.chat, "let people chat: true or false")->capture_default_str();
  app.add_option("--log-chat", net.log_chat, "write chat into the log, too: true or false")
      ->capture_default_str();
  add_threads(app, "--net-threads", net.net_threads, "encode and send");
  app.add_option("--web", raw.web,
                 "folder of the page for browsers (./scree web builds it); off: no HTTP; default: the folder "
                 "beside this program (../share/scree/web, ../../web/dist)");
  app.add_option("--web-origin", net.web.origins,
                 "another site whose pages may join, such as https://game.example; repeatable");
  app.add_option(
         "--web-host", net.web.hosts,
         "names by which browsers reach this server, such as play.example.org, separated by commas; its "
         "addresses in numbers, localhost and the machine's own name need none")
      ->delimiter(',');
}

void add_world(CLI::App& app, Raw& raw) {
  WorldConfig& world = raw.options.live.world;
  CLI::Option* terrain = app.add_option("--terrain", raw.terrain, listed(kind_names<TerrainKind>));
  terrain->check(CLI::IsMember(names_of_kind<TerrainKind>()))->capture_default_str();
  app.add_option("--ground", raw.ground,
                 "ground file (scree import makes it), used instead of generated terrain; a saved world or a "
                 "recording finds its ground file in its own folder")
      ->excludes(terrain);
  app.add_option(
      "--materials", raw.materials,
      "file of the world's materials (TOML; content/materials.toml is the built-in one); a saved "
      "world continues with its own, or with this file: the same materials with other numbers, and "
      "more at the end");
  app.add_option(
      "--models", raw.models,
      "folder of models (.glb, binary glTF 2.0) by which clients draw props that name them by their "
      "SHA-256");
  bounded(app.add_option("--seed", world.terrain.random_seed, "random seed of the terrain"),
          whole_within(0, std::numeric_limits<uint32_t>::max()))
      ->capture_default_str();
  bounded(app.add_option("--voxel-size", world.terrain.voxel_size_m, "metres"),
          {limits::voxel_size_min_m, limits::voxel_size_max_m})
      ->capture_default_str();
  bounded(app.add_option("--tick-rate", world.tick_rate_hz, "ticks a second"),
          whole_within(limits::tick_rate_min_hz, limits::tick_rate_max_hz))
      ->capture_default_str();
  add_threads(app, "--sim-threads", raw.options.live.sim_threads, "step the bodies");
  raw.options.live.governed = true;
  app.add_option("--govern", raw.options.live.governed,
                 "lower work-percent if ticks are late, and restore it once they are on time: true or false")
      ->capture_default_str();
}

/// Every row of the table of settings is an option.
void add_settings(CLI::App& app, Raw& raw) {
  for (const Setting& row : settings()) {
    const auto set_value = [&live = raw.options.live, &row](const std::string& value) {
      const SettingValue setting{std::string(row.name), value};
      if (Result<void> done = set(live.world, setting); !done)
        throw CLI::ValidationError(done.error().message);
      if (row.of_machine) live.machine_limits.push_back({setting.name, row.print(live.world)});
    };
    app.add_option_function<std::string>("--" + std::string(row.name), set_value,
                                         std::string(row.help) + ": " + row.may_be())
        ->default_str(row.print(WorldConfig{}));
  }
}

/// The world's file.
void add_saving_options(CLI::App& app, Raw& raw) {
  LiveConfig& live = raw.options.live;
  CLI::Option* world =
      app.add_option("--world", live.world_path,
                     "file that keeps the world: made if it is missing, otherwise the saved world continues");
  app.add_option("--durability", raw.durability,
                 "when the world is saved: after each tick, each second, or off: at the end, every "
                 "--autosave seconds, and when much is unsaved")
      ->check(CLI::IsMember(names_of_kind<Durability>()))
      ->capture_default_str()
      ->needs(world);
  bounded(app.add_option("--autosave", live.autosave_s,
                         "with --durability off: seconds between saves; 0: only at the end"),
          {0.0, 86400.0})
      ->capture_default_str()
      ->needs(world);
  bounded(
      app.add_option("--history-mb", live.history_mb,
                     "megabytes for who edited what, and what it was before, by which administrators take "
                     "edits back; 0: nothing is remembered"),
      whole_within(0, limits::history_mb_max))
      ->capture_default_str();
}

void add_recordings(CLI::App& app, Raw& raw) {
  LiveConfig& live = raw.options.live;
  CLI::Option* record = app.add_option(
      "--record", live.record_path,
      "records the session to this new file; if the --world continues, its recording continues, too");
  const auto parse_ring = [&live](const std::string& text) {
    const auto limit = ring_limit_of(text);
    if (!limit) throw CLI::ValidationError("--record-ring", limit.error().message);
    live.record_ring = *limit;
  };
  app.add_option_function<std::string>(
         "--record-ring", parse_ring,
         "keeps only the end of the recording: a time (90s, 10m or 2h) or bytes (500M, 2G or 1T)")
      ->needs(record);
  CLI::Option* replay =
      app.add_option("--replay", live.replay.path, "plays this recording instead of a simulation");
  replay->excludes(record);
  for (const char* of_the_recording :
       {"--terrain", "--materials", "--seed", "--voxel-size", "--tick-rate", "--govern"})
    replay->excludes(app.get_option(of_the_recording));
  bounded(app.add_option("--from", live.replay.from, "starts after this tick of the recording"),
          whole_within(0, whole_most))
      ->needs(replay);
  bounded(app.add_option("--speed", live.replay.speed, "speed of the replay, in multiples of real time"),
          {replay_speed_least, replay_speed_most})
      ->needs(replay);
  CLI::Option* loop =
      app.add_flag("--loop", raw.loop, "restarts the replay at its end, instead of stopping there");
  loop->needs(replay);
  app.add_flag("--end", raw.end, "ends the server when the replay ends")->needs(replay)->excludes(loop);
  app.add_option("--events", live.events_path, "appends the events to this file, one a line (JSON Lines)")
      ->check(check_writable, "FILE")
      ->excludes(replay);
}

void add_run(CLI::App& app, Raw& raw) {
  LiveConfig& live = raw.options.live;
  bounded(app.add_option("--ticks", live.ticks_max, "ends the server after so many ticks; 0: no limit"),
          whole_within(0, whole_most))
      ->capture_default_str();
  bounded(
      app.add_option("--duration", live.seconds_max, "ends the server after so many seconds; 0: no limit"),
      {0.0, 1.0e9})
      ->capture_default_str();
  bounded(
      app.add_option("--wait-clients", live.wait_clients, "number of clients for which the first tick waits"),
      whole_within(0, std::numeric_limits<uint32_t>::max()))
      ->capture_default_str();
  app.add_option("--report", raw.options.report_path, "writes a report to this file at the end (JSON)")
      ->check(check_writable, "FILE");
  app.add_option(
         "--trace", live.trace_path,
         "writes the times of all work to this file at the end; chrome://tracing and ui.perfetto.dev open it")
      ->check(check_writable, "FILE");
  declare_log_options(app, raw.options.log);
}

/// A folder that was named has a page; the one beside the program may be missing.
void parse_web(Raw& raw) {
  WebConfig& web = raw.options.live.net.web;
  web.on = raw.web != "off";
  web.folder = raw.web.empty() ? web_folder_beside_program() : raw.web;
  if (!web.on) web.folder.clear();
  for (const std::string& origin : web.origins)
    if (!is_origin(origin))
      throw CLI::ValidationError("--web-origin", "'" + origin +
                                                     "' is not a site: write http:// or https://, a host, a "
                                                     "port if it is not the default, and nothing more");
  for (const std::string& host : web.hosts)
    if (const auto good = check_host_name(host); !good)
      throw CLI::ValidationError("--web-host", good.error().message);
  if (raw.web.empty() || !web.on) return;
  const auto files = web_files(web);
  if (!files) throw CLI::ValidationError("--web", files.error().message);
}

void parse_models(Raw& raw) {
  if (raw.models.empty()) return;
  auto folder = read_model_folder(raw.models);
  if (!folder) throw CLI::ValidationError("--models", folder.error().message);
  raw.options.live.models = std::move(folder->contents);
  raw.options.models = std::move(folder->files);
}

/// A world's own limits are the only ones. Settings come in any order, so they are compared here, at last.
void parse_world(Raw& raw) {
  WorldConfig& world = raw.options.live.world;
  if (!raw.ground.empty()) {
    if (auto taken = set_ground(raw.ground, world); !taken)
      throw CLI::ValidationError("--ground", taken.error().message);
  }
  world.terrain.kind = *kind_named<TerrainKind>(raw.terrain);
  if (!raw.materials.empty())
    if (const auto set = set_materials(raw.materials, raw.options.live); !set)
      throw CLI::ValidationError("--materials", set.error().message);
  if (Result<void> valid = validate(world); !valid) throw CLI::ValidationError(valid.error().message);
}

/// The files that it names, with what is done to them.
void refuse_shared_files(const Raw& raw, const std::string& config_path) {
  const LiveConfig& live = raw.options.live;
  const AccessConfig& access = live.net.access;
  const std::array files = {NamedFile{"--config", config_path},
                            NamedFile{"--ground", raw.ground},
                            NamedFile{"--materials", raw.materials},
                            NamedFile{"--replay", live.replay.path, false, true},
                            NamedFile{"--admin-token-file", raw.doors.token_path(), raw.doors.makes_token()},
                            NamedFile{"--admin-socket", live.net.admin_socket, true},
                            NamedFile{"--tls-cert", access.tls_certificate_path},
                            NamedFile{"--tls-key", access.tls_key_path},
                            NamedFile{"--token-key", access.token_key_path},
                            NamedFile{"--token-revoked", access.token_revoked_path},
                            NamedFile{"--bans", access.bans_path, true},
                            NamedFile{"--nats-creds", raw.options.bus.bus.credentials_path},
                            NamedFile{"--nats-ca", raw.options.bus.bus.ca_path},
                            NamedFile{"--world", live.world_path, true, true},
                            NamedFile{"--record", live.record_path, true, true},
                            NamedFile{"--events", live.events_path, true},
                            NamedFile{"--report", raw.options.report_path, true},
                            NamedFile{"--slow-log", live.slow_log_path, true},
                            NamedFile{"--trace", live.trace_path, true}};
  if (Result<void> distinct = check_distinct(files); !distinct)
    throw CLI::ValidationError(distinct.error().message);
}

void declare(CLI::App& app, Raw& raw) {
  add_preset(app, raw);
  add_network(app, raw);
  add_world(app, raw);
  add_settings(app, raw);
  raw.doors.declare(app, raw.options.live.net);
  add_saving_options(app, raw);
  declare_backups(app, raw.options.live.backups);
  add_recordings(app, raw);
  raw.rules.declare(app, raw.options.rules);
  raw.options.bus.declare(app);
  declare_agones(app, raw.options.agones);
  add_run(app, raw);
  declare_flight(app, raw.options.live);
  refuse_empty(app);
}

/// What is wrong with this entry of the file, taken as an option alone; empty: nothing.
std::string fault_of(const CLI::ConfigItem& item) {
  CLI::App app;
  Raw raw;
  declare(app, raw);
  const std::string flag = "--" + item.fullname();
  if (app.get_option_no_throw(flag) == nullptr) return "there is no option '" + item.fullname() + "'";
  if (item.inputs.empty()) return flag + ": there is no value";
  std::vector<std::string> arguments;  // the last comes first
  for (const std::string& input : item.inputs) arguments.push_back(flag + "=" + input);
  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::RequiresError&) {  // other lines may have them
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

ServerOptionsRead read_server_options(int argc, const char* const* argv, OptionsUse use) {
  CLI::App app("A dedicated server for terrain that breaks, falls, and becomes terrain again.",
               "scree-server");
  Raw raw;
  app.set_version_flag("--version", SCREE_VERSION);
  name_unknown_words<CLI::ExtrasError>(app);
  CLI::Option* const config =
      app.set_config("--config", "", "a TOML file with these options, under the same names");
  config->check(CLI::Validator([](std::string& path) { return fault_of_file(path); }, ""));
  app.allow_config_extras(CLI::config_extras_mode::error);
  declare(app, raw);
  const std::vector<std::string> variables = name_variables(app);
  std::vector<OptionValue> values;
  try {
    if (const std::string fault = fault_in_environment(variables, environ); !fault.empty())
      throw CLI::ValidationError(fault);
    forget_flags_that_say_no(app);
    const std::vector<const char*> given(argv, argv + argc), arguments = with_config_of_environment(given);
    app.parse(static_cast<int>(arguments.size()), arguments.data());
    const OptionSources sources(app, given, named_file(*config));
    if (const auto preset = kind_named<Preset>(raw.preset)) apply_preset(app, *preset, server_preset_options);
    values = sources.values(app);
    refuse_shared_files(raw, named_file(*config));
    raw.doors.complete(raw.options.live.net, use == OptionsUse::start);
    raw.options.token_made = raw.doors.token_made();
    raw.options.bus.complete(raw.options.live.net.access.world);
    complete_agones(raw.options.agones, raw.options.live.net.access.world, raw.options.bus.edge);
    raw.options.live.durability = *kind_named<Durability>(raw.durability);
    if (raw.loop) raw.options.live.replay.at_end = AtEnd::loop;
    if (raw.end) raw.options.live.replay.at_end = AtEnd::end;
    parse_web(raw);
    parse_world(raw);
    parse_models(raw);
    raw.rules.complete(raw.options.rules);
  } catch (const CLI::ParseError& error) {
    const bool mistaken = error.get_exit_code() != 0;
    const std::string fault = mistaken ? fault_in_file(named_file(*config), fault_of) : std::string();
    if (!fault.empty()) return OptionsEnd{usage_error, "", fmt::format("scree-server: {}\n", fault)};
    std::ostringstream out, err;
    const int code = app.exit(error, out, err);
    return OptionsEnd{code == 0 ? 0 : usage_error, out.str(), err.str()};
  }
  raw.options.values = std::move(values);
  raw.options.config_path = named_file(*config);
  return raw.options;
}

int print_end(const OptionsEnd& end) {
  std::fputs(end.out.c_str(), stdout);
  std::fputs(end.err.c_str(), stderr);
  return end.code;
}

std::variant<ServerOptions, int> parse_server_options(int argc, const char* const* argv) {
  ServerOptionsRead read = read_server_options(argc, argv, OptionsUse::start);
  if (auto* options = std::get_if<ServerOptions>(&read)) return std::move(*options);
  return print_end(std::get<OptionsEnd>(read));
}

}  // namespace scree
