// scree-admin: shows the status of a running server, shows and changes its settings, manages its sessions,
// and lists, asks about and changes the bodies of its world. Exit status: 0 success, 1 failure or refusal, 2
// wrong usage.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "client/admin/admin.h"
#include "client/admin/programs/world_commands.h"
#include "client/connection/endpoint_options.h"
#include "proto/limits.h"
#include "shared/base/near_name.h"
#include "shared/base/option_check.h"

namespace {

constexpr int exit_failed = 1;
constexpr int exit_usage = 2;

struct Options {
  scree::AdminServer server;
  double timeout_s = 10.0;
  std::vector<std::string> changes;
  std::string whom;  ///< a session's number, an address, or a material
  uint32_t minutes = 0;
  std::string reason;
  std::vector<std::string> place;
  bool json = false;
  bool alive = false, ready = false;
  bool play = false, pause = false;
  double speed = 0.0;
  std::optional<uint64_t> to_tick;
  std::optional<int64_t> steps;
  std::optional<double> time_s;
  bool next_event = false, previous_event = false;
};

int complain(const scree::Error& error, int code) {
  std::fprintf(stderr, "scree-admin: error: %s\n", error.message.c_str());
  return code;
}

int print(const scree::Result<scree::SettingValues>& settings, bool as_json) {
  if (!settings) return complain(settings.error(), exit_failed);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const scree::SettingValue& setting : *settings) {
    json[setting.name] = setting.value;
    if (!as_json) std::printf("%-26s %s\n", setting.name.c_str(), setting.value.c_str());
  }
  if (as_json) std::printf("%s\n", json.dump(2).c_str());
  return 0;
}

int print_status(const Options& options) {
  const auto named = scree::read_named_status(options.server);
  if (!named) return complain(named.error(), exit_failed);
  const auto text = options.json ? scree::status_json : scree::status_lines;
  std::fputs(text(named->status, named->materials).c_str(), stdout);
  return 0;
}

int show_materials(const Options& options) {
  const auto palette = scree::read_materials(options.server);
  if (!palette) return complain(palette.error(), exit_failed);
  if (options.whom.empty()) {
    std::fputs((options.json ? scree::materials_json : scree::materials_lines)(*palette).c_str(), stdout);
    return 0;
  }
  const auto material = scree::material_named(*palette, options.whom);
  if (!material) return complain(material.error(), exit_failed);
  const scree::MaterialRow& row = palette->row(*material);
  const auto images = scree::read_images(options.server, row);
  if (!images) return complain(images.error(), exit_failed);
  const auto text = options.json ? scree::material_json : scree::material_lines;
  std::fputs(text(row, *images).c_str(), stdout);
  return 0;
}

int health(const Options& options) {
  const auto health = scree::read_health(options.server);
  if (!health) return complain(health.error(), exit_failed);
  std::fputs((options.json ? scree::health_json(*health) : scree::health_lines(*health)).c_str(), stdout);
  const bool good = options.alive ? health->alive : options.ready ? health->ready : health->well;
  return good ? 0 : exit_failed;
}

scree::Result<scree::SettingValues> parse(const std::vector<std::string>& changes) {
  scree::SettingValues parsed;
  for (const std::string& change : changes) {
    const size_t sign = change.find('=');
    if (sign == std::string::npos || sign == 0) return scree::fail("'" + change + "' is not NAME=VALUE");
    parsed.push_back({change.substr(0, sign), change.substr(sign + 1)});
  }
  return parsed;
}

int change(const Options& options) {
  const auto changes = parse(options.changes);
  if (!changes) return complain(changes.error(), exit_usage);
  return print(scree::change_settings(options.server, *changes), options.json);
}

int change_materials(const Options& options) {
  const auto changes = parse(options.changes);
  if (!changes) return complain(changes.error(), exit_usage);
  return print(scree::change_materials(options.server, *changes), options.json);
}

/// "here", "here 7", "auto", or the numbers of a place.
int place_spawn(const Options& options) {
  const bool in_words = options.place.front() == "here" || options.place.front() == "auto";
  std::string value;
  for (const std::string& part : options.place) {
    if (!value.empty()) value += in_words ? ' ' : ',';
    value += part;
  }
  const auto settings = scree::change_settings(options.server, {{"spawn", value}});
  if (!settings) return complain(settings.error(), exit_failed);
  scree::SettingValues spawn = *settings;
  std::erase_if(spawn, [](const auto& setting) { return setting.name != "spawn"; });
  return print(spawn, options.json);
}

int print_sessions(const Options& options) {
  const auto sessions = scree::list_sessions(options.server);
  if (!sessions) return complain(sessions.error(), exit_failed);
  std::fputs((options.json ? scree::sessions_json(*sessions) : scree::sessions_lines(*sessions)).c_str(),
             stdout);
  return 0;
}

int print_bans(const Options& options) {
  const auto bans = scree::list_bans(options.server);
  if (!bans) return complain(bans.error(), exit_failed);
  std::fputs((options.json ? scree::bans_json(*bans) : scree::bans_lines(*bans)).c_str(), stdout);
  return 0;
}

int told(const scree::Result<void>& done) {
  return done ? 0 : complain(done.error(), exit_failed);
}

/// The number of a session; nothing for what is none.
std::optional<uint64_t> session_number(const std::string& text) {
  uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stopped != end || number == 0) return std::nullopt;
  return number;
}

int kick(const Options& options) {
  const auto session = session_number(options.whom);
  if (!session)
    return complain(
        {"'" + options.whom + "' is not the number of a session; scree admin sessions lists them"},
        exit_usage);
  return told(scree::kick_session(options.server, {*session, options.reason}));
}

int ban(const Options& options) {
  const auto session = session_number(options.whom);
  return told(scree::ban_address(options.server, {session.value_or(0), session ? std::string() : options.whom,
                                                  options.minutes, options.reason}));
}

scree::ControlReplayRequest wish_of(const Options& options) {
  scree::ControlReplayRequest wish;
  if (options.play) wish.play = scree::ReplayPlay::play;
  if (options.pause) wish.play = scree::ReplayPlay::pause;
  wish.speed = static_cast<float>(options.speed);
  const auto move = [&](scree::ReplayMove kind, int64_t value) {
    wish.move = kind;
    wish.value = value;
  };
  if (options.to_tick) move(scree::ReplayMove::to_tick, static_cast<int64_t>(*options.to_tick));
  if (options.steps) move(scree::ReplayMove::by_ticks, *options.steps);
  if (options.time_s) move(scree::ReplayMove::to_time, std::llround(*options.time_s * 1000.0));
  if (options.next_event) move(scree::ReplayMove::next_event, 0);
  if (options.previous_event) move(scree::ReplayMove::previous_event, 0);
  return wish;
}

int control(const Options& options) {
  const auto playback = scree::control_replay(options.server, wish_of(options));
  if (!playback) return complain(playback.error(), exit_failed);
  if (const std::string other = scree::went_elsewhere(wish_of(options), *playback); !other.empty())
    std::fprintf(stderr, "scree-admin: %s\n", other.c_str());
  std::fputs((options.json ? scree::playback_json(*playback) : scree::playback_lines(*playback)).c_str(),
             stdout);
  return 0;
}

void add_control_options(CLI::App* command, Options& options) {
  CLI::Option* play = command->add_flag("--play", options.play, "continues the replay");
  command->add_flag("--pause", options.pause, "stops the replay")->excludes(play);
  const double most = scree::replay_speed_most;
  scree::bounded(
      command->add_option("--speed", options.speed,
                          "speed in multiples of real time, 0.1 to 16; a negative speed plays backwards"),
      {-most, most})
      ->check(
          [](const std::string& text) {
            const bool stands = std::abs(std::strtod(text.c_str(), nullptr)) < scree::replay_speed_least;
            return stands ? "a speed is at least 0.1 or at most -0.1; --pause stops the replay" : "";
          },
          "");
  CLI::Option_group* const moves = command->add_option_group("moves", "at most one of these");
  scree::bounded(moves->add_option("--to", options.to_tick, "goes to this tick"),
                 scree::whole_within(0, scree::whole_most));
  scree::bounded(moves->add_option("--step", options.steps,
                                   "moves by this number of ticks; a negative number moves back"),
                 scree::whole_within(-scree::whole_most, scree::whole_most));
  scree::bounded(moves->add_option("--time", options.time_s, "goes to this second of the recording"),
                 {0.0, 1.0e9});
  moves->add_flag("--next-event", options.next_event, "goes to the next tick in which something happened");
  moves->add_flag("--previous-event", options.previous_event,
                  "goes to the previous tick in which something happened");
  moves->require_option(0, 1);
}

using Run = int (*)(const Options&);

/// The subcommand of materials, which has two of its own.
std::pair<CLI::App*, CLI::App*> add_material_commands(CLI::App& app, Options& options) {
  CLI::App* materials = app.add_subcommand("materials", "shows and changes what the world is made of");
  materials->require_subcommand(1);
  materials->fallthrough();
  CLI::App* show = materials->add_subcommand("show", "prints all materials, or all members of one");
  show->add_option("NAME", options.whom, "name of a material");
  CLI::App* set = materials->add_subcommand(
      "set", "changes all of these numbers or none, and prints all that differ from the palette's own");
  set->add_option("NAME.MEMBER=VALUE", options.changes,
                  "such as brick.strength=12; the value default takes the palette's own again")
      ->required();
  return {show, set};
}

/// A row each: what to run when the subcommand was given.
std::vector<std::pair<const CLI::App*, Run>> add_commands(CLI::App& app, Options& options) {
  const auto add = [&](const char* name, const char* what) { return app.add_subcommand(name, what); };
  CLI::App* show = add("show", "prints every setting");
  CLI::App* status =
      add("status", "prints the times and the work of the last second's ticks, and the ledger");
  CLI::App* healthy = add("health", "asks whether the server is healthy; exits with 1 when it is not");
  CLI::Option* alive =
      healthy->add_flag("--alive", options.alive, "asks only whether the server ticks and answers");
  healthy->add_flag("--ready", options.ready, "asks whether the server has a place for a player")
      ->excludes(alive);
  CLI::App* set = add("set", "changes all of these settings or none, and prints every setting");
  set->add_option("NAME=VALUE", options.changes, "a setting; scree-server --help lists them")->required();
  CLI::App* spawn = add("spawn", "sets where visitors begin, and their direction of view");
  spawn
      ->add_option(
          "PLACE", options.place,
          "X Y Z or X Y Z YAW PITCH in metres and degrees; here: your eye in the window or the page; "
          "here SESSION: the eye of that session; auto: a place that the ground suggests")
      ->required()
      ->expected(1, 5);
  CLI::App* sessions = add("sessions", "lists the sessions, with role and address");
  CLI::App* kicked = add("kick", "ends a session");
  kicked->add_option("SESSION", options.whom, "number of the session")->required();
  CLI::App* banned = add("ban", "bans an address, a network, a name or a token, and ends such sessions");
  banned
      ->add_option(
          "WHOM", options.whom,
          "203.0.113.9, 203.0.113.0/24, name:NAME, token:ID, or the number of a session, whose address "
          "is banned")
      ->required();
  scree::bounded(banned->add_option("--minutes", options.minutes,
                                    "length of the ban in minutes; 0: until somebody lifts it"),
                 scree::whole_within(0, scree::limits::ban_minutes_max))
      ->capture_default_str();
  for (CLI::App* command : {kicked, banned})
    command->add_option("--reason", options.reason, "reason, which the client is shown");
  CLI::App* replay = add("replay", "controls a server's replay, and prints its position");
  add_control_options(replay, options);
  const auto [show_material, set_material] = add_material_commands(app, options);
  CLI::App* bans = add("bans", "lists the bans");
  CLI::App* unban = add("unban", "lifts a ban");
  unban->add_option("WHOM", options.whom, "address, network, name or token, as `bans` lists it")->required();
  return {{show, [](const Options& o) { return print(scree::read_settings(o.server), o.json); }},
          {status, print_status},
          {show_material, show_materials},
          {set_material, change_materials},
          {healthy, health},
          {set, change},
          {spawn, place_spawn},
          {sessions, print_sessions},
          {kicked, kick},
          {banned, ban},
          {replay, control},
          {bans, print_bans},
          {unban, [](const Options& o) { return told(scree::lift_ban(o.server, {o.whom})); }}};
}

int run_on_world(const scree::WorldCommand& command, const Options& options) {
  const scree::Printed printed = command.run(options.server, options.json);
  if (!printed)
    return complain({printed.error().message}, printed.error().misused ? exit_usage : exit_failed);
  std::fputs(printed->c_str(), stdout);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Shows the state of a running server, changes its settings and its world, and manages its "
      "sessions.",
      "scree-admin");
  app.set_version_flag("--version", SCREE_VERSION);
  app.require_subcommand(0, 1);  // a mistyped one would pass as none
  scree::name_unknown_words<CLI::ExtrasError>(app);
  scree::EndpointOptions endpoint(app, options.server, "SCREE_ADMIN_TOKEN");
  scree::bounded(app.add_option("--timeout", options.timeout_s, "seconds to wait for the server's answers"),
                 {0.1, 3600.0})
      ->capture_default_str();
  app.add_flag("--json", options.json, "prints JSON");
  app.fallthrough();
  const auto commands = add_commands(app, options);
  scree::WorldCommands of_world;
  scree::add_list_commands(app, of_world);
  scree::add_prop_commands(app, of_world);
  scree::add_joint_commands(app, of_world);
  scree::add_ask_commands(app, of_world);
  scree::add_region_commands(app, of_world);
  scree::add_store_commands(app, of_world);
  scree::add_rules_commands(app, of_world);
  scree::add_history_commands(app, of_world);
  scree::add_flight_commands(app, of_world);
  scree::add_lines_commands(app, of_world);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A subcommand");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_usage;
  }
  // Health needs no token, and an operator may keep the file that the environment names elsewhere.
  const bool asks_health = app.got_subcommand("health");
  if (asks_health) endpoint.drop_token();
  if (const auto completed = endpoint.complete(); !completed)
    return complain(completed.error(), asks_health ? exit_failed : exit_usage);
  options.server.within = std::chrono::milliseconds(static_cast<int64_t>(options.timeout_s * 1000.0));
  for (const auto& [command, run] : commands)
    if (command->parsed()) return run(options);
  for (const scree::WorldCommand& command : of_world)
    if (command.command->parsed()) return run_on_world(command, options);
  return exit_usage;
}
