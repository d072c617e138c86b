// The subcommands about the server itself: its settings, status, materials, sessions, bans and replay.
#include "client/admin/programs/server_commands.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "proto/limits.h"
#include "shared/base/option_check.h"

namespace scree {

namespace {

int print(const Result<SettingValues>& settings, bool as_json) {
  if (!settings) return complain(settings.error(), exit_failed);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const SettingValue& setting : *settings) {
    json[setting.name] = setting.value;
    if (!as_json) std::printf("%-26s %s\n", setting.name.c_str(), setting.value.c_str());
  }
  if (as_json) std::printf("%s\n", json.dump(2).c_str());
  return 0;
}

int print_status(const AdminOptions& options) {
  const auto named = read_named_status(options.server);
  if (!named) return complain(named.error(), exit_failed);
  const auto text = options.json ? status_json : status_lines;
  std::fputs(text(named->status, named->materials).c_str(), stdout);
  return 0;
}

int show_materials(const AdminOptions& options) {
  const auto palette = read_materials(options.server);
  if (!palette) return complain(palette.error(), exit_failed);
  if (options.whom.empty()) {
    std::fputs((options.json ? materials_json : materials_lines)(*palette).c_str(), stdout);
    return 0;
  }
  const auto material = material_named(*palette, options.whom);
  if (!material) return complain(material.error(), exit_failed);
  const MaterialRow& row = palette->row(*material);
  const auto images = read_images(options.server, row);
  if (!images) return complain(images.error(), exit_failed);
  const auto text = options.json ? material_json : material_lines;
  std::fputs(text(row, *images).c_str(), stdout);
  return 0;
}

int health(const AdminOptions& options) {
  const auto health = read_health(options.server);
  if (!health) return complain(health.error(), exit_failed);
  std::fputs((options.json ? health_json(*health) : health_lines(*health)).c_str(), stdout);
  const bool good = options.alive ? health->alive : options.ready ? health->ready : health->well;
  return good ? 0 : exit_failed;
}

Result<SettingValues> parse(const std::vector<std::string>& changes) {
  SettingValues parsed;
  for (const std::string& change : changes) {
    const size_t sign = change.find('=');
    if (sign == std::string::npos || sign == 0) return fail("'" + change + "' is not NAME=VALUE");
    parsed.push_back({change.substr(0, sign), change.substr(sign + 1)});
  }
  return parsed;
}

int change(const AdminOptions& options) {
  const auto changes = parse(options.changes);
  if (!changes) return complain(changes.error(), exit_usage);
  return print(change_settings(options.server, *changes), options.json);
}

int change_materials(const AdminOptions& options) {
  const auto changes = parse(options.changes);
  if (!changes) return complain(changes.error(), exit_usage);
  return print(change_materials(options.server, *changes), options.json);
}

/// "here", "here 7", "auto", or the numbers of a place.
int place_spawn(const AdminOptions& options) {
  const bool in_words = options.place.front() == "here" || options.place.front() == "auto";
  std::string value;
  for (const std::string& part : options.place) {
    if (!value.empty()) value += in_words ? ' ' : ',';
    value += part;
  }
  const auto settings = change_settings(options.server, {{"spawn", value}});
  if (!settings) return complain(settings.error(), exit_failed);
  SettingValues spawn = *settings;
  std::erase_if(spawn, [](const auto& setting) { return setting.name != "spawn"; });
  return print(spawn, options.json);
}

int print_sessions(const AdminOptions& options) {
  const auto sessions = list_sessions(options.server);
  if (!sessions) return complain(sessions.error(), exit_failed);
  std::fputs((options.json ? sessions_json(*sessions) : sessions_lines(*sessions)).c_str(), stdout);
  return 0;
}

int print_bans(const AdminOptions& options) {
  const auto bans = list_bans(options.server);
  if (!bans) return complain(bans.error(), exit_failed);
  std::fputs((options.json ? bans_json(*bans) : bans_lines(*bans)).c_str(), stdout);
  return 0;
}

int told(const Result<void>& done) {
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

int kick(const AdminOptions& options) {
  const auto session = session_number(options.whom);
  if (!session)
    return complain(
        {"'" + options.whom + "' is not the number of a session; scree admin sessions lists them"},
        exit_usage);
  return told(kick_session(options.server, {*session, options.reason}));
}

int ban(const AdminOptions& options) {
  const auto session = session_number(options.whom);
  return told(ban_address(options.server, {session.value_or(0), session ? std::string() : options.whom,
                                           options.minutes, options.reason}));
}

ControlReplayRequest wish_of(const AdminOptions& options) {
  ControlReplayRequest wish;
  if (options.play) wish.play = ReplayPlay::play;
  if (options.pause) wish.play = ReplayPlay::pause;
  wish.speed = static_cast<float>(options.speed);
  const auto move = [&](ReplayMove kind, int64_t value) {
    wish.move = kind;
    wish.value = value;
  };
  if (options.to_tick) move(ReplayMove::to_tick, static_cast<int64_t>(*options.to_tick));
  if (options.steps) move(ReplayMove::by_ticks, *options.steps);
  if (options.time_s) move(ReplayMove::to_time, std::llround(*options.time_s * 1000.0));
  if (options.next_event) move(ReplayMove::next_event, 0);
  if (options.previous_event) move(ReplayMove::previous_event, 0);
  return wish;
}

int control(const AdminOptions& options) {
  const auto playback = control_replay(options.server, wish_of(options));
  if (!playback) return complain(playback.error(), exit_failed);
  if (const std::string other = went_elsewhere(wish_of(options), *playback); !other.empty())
    std::fprintf(stderr, "scree-admin: %s\n", other.c_str());
  std::fputs((options.json ? playback_json(*playback) : playback_lines(*playback)).c_str(), stdout);
  return 0;
}

void add_control_options(CLI::App* command, AdminOptions& options) {
  CLI::Option* play = command->add_flag("--play", options.play, "continues the replay");
  command->add_flag("--pause", options.pause, "stops the replay")->excludes(play);
  const double most = replay_speed_most;
  bounded(command->add_option("--speed", options.speed,
                              "speed in multiples of real time, 0.1 to 16; a negative speed plays backwards"),
          {-most, most})
      ->check(
          [](const std::string& text) {
            const bool stands = std::abs(std::strtod(text.c_str(), nullptr)) < replay_speed_least;
            return stands ? "a speed is at least 0.1 or at most -0.1; --pause stops the replay" : "";
          },
          "");
  CLI::Option_group* const moves = command->add_option_group("moves", "at most one of these");
  bounded(moves->add_option("--to", options.to_tick, "goes to this tick"), whole_within(0, whole_most));
  bounded(moves->add_option("--step", options.steps,
                            "moves by this number of ticks; a negative number moves back"),
          whole_within(-whole_most, whole_most));
  bounded(moves->add_option("--time", options.time_s, "goes to this second of the recording"), {0.0, 1.0e9});
  moves->add_flag("--next-event", options.next_event, "goes to the next tick in which something happened");
  moves->add_flag("--previous-event", options.previous_event,
                  "goes to the previous tick in which something happened");
  moves->require_option(0, 1);
}

/// The subcommand of materials, which has two of its own.
std::pair<CLI::App*, CLI::App*> add_material_commands(CLI::App& app, AdminOptions& options) {
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

}  // namespace

int complain(const Error& error, int code) {
  std::fprintf(stderr, "scree-admin: error: %s\n", error.message.c_str());
  return code;
}

AdminCommands add_server_commands(CLI::App& app, AdminOptions& options) {
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
  bounded(banned->add_option("--minutes", options.minutes,
                             "length of the ban in minutes; 0: until somebody lifts it"),
          whole_within(0, limits::ban_minutes_max))
      ->capture_default_str();
  for (CLI::App* command : {kicked, banned})
    command->add_option("--reason", options.reason, "reason, which the client is shown");
  CLI::App* replay = add("replay", "controls a server's replay, and prints its position");
  add_control_options(replay, options);
  const auto [show_material, set_material] = add_material_commands(app, options);
  CLI::App* bans = add("bans", "lists the bans");
  CLI::App* unban = add("unban", "lifts a ban");
  unban->add_option("WHOM", options.whom, "address, network, name or token, as `bans` lists it")->required();
  return {{show, [](const AdminOptions& o) { return print(read_settings(o.server), o.json); }},
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
          {unban, [](const AdminOptions& o) { return told(lift_ban(o.server, {o.whom})); }}};
}

}  // namespace scree
