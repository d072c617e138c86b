// The command line of scree-server, its file and its environment.
#include "server/app/server_options.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "proto/messages.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_ground.h"

namespace scree {
namespace {

std::variant<ServerOptions, int> parse(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "scree-server");
  return parse_server_options(static_cast<int>(arguments.size()), arguments.data());
}

int exit_code(std::vector<const char*> arguments) {
  const auto parsed = parse(std::move(arguments));
  const int* code = std::get_if<int>(&parsed);
  return code == nullptr ? -1 : *code;
}

TEST(ServerOptions, defaults_listen_on_this_machine_only) {
  const auto parsed = parse({});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parsed));
  const LiveConfig& live = std::get<ServerOptions>(parsed).live;
  EXPECT_EQ(live.net.bind, "127.0.0.1");
  EXPECT_EQ(live.net.port, default_port);
  EXPECT_EQ(live.world, WorldConfig{});
}

TEST(ServerOptions, flags_are_taken) {
  const auto parsed = parse({"--port",        "0",       "--host",        "0.0.0.0", "--terrain",   "noise",
                             "--seed",        "9",       "--voxel-size",  "0.5",     "--tick-rate", "30",
                             "--record",      "a.scree", "--impacts",     "false",   "--dents",     "false",
                             "--net-threads", "3",       "--sim-threads", "2",       "--chat",      "false"});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parsed));
  const LiveConfig& live = std::get<ServerOptions>(parsed).live;
  EXPECT_EQ(live.net.port, 0);
  EXPECT_EQ(live.net.bind, "0.0.0.0");
  EXPECT_EQ(live.net.net_threads, 3U);
  EXPECT_FALSE(live.net.chat);
  EXPECT_EQ(live.sim_threads, 2U);
  EXPECT_EQ(live.world.terrain, (TerrainSource{TerrainKind::noise, 9, 0.5F}));
  EXPECT_EQ(live.world.tick_rate_hz, 30U);
  EXPECT_EQ(live.record_path, "a.scree");
  EXPECT_FALSE(live.world.methods.impacts);
  EXPECT_FALSE(live.world.methods.dents);
}

TEST(ServerOptions, limits_of_the_machine_that_are_said_are_told_apart_from_the_worlds_settings) {
  const auto limits_of = [](std::vector<const char*> arguments) {
    const auto parsed = parse(std::move(arguments));
    return std::get<ServerOptions>(parsed).live.machine_limits;
  };
  EXPECT_TRUE(limits_of({"--collider", "mesh", "--impacts", "false"}).empty());
  EXPECT_EQ(limits_of({"--memory-max", "512", "--collider", "mesh"}), (SettingValues{{"memory-max", "512"}}));
  EXPECT_EQ(limits_of({"--preset", "laptop", "--sessions-max", "9"}).size(), 4U)
      << "sessions-max once, pieces-max, memory-max and work-percent by the preset";
}

TEST(ServerOptions, a_ring_is_a_recordings_and_has_a_unit) {
  const auto parsed = parse({"--record", "a.scree", "--record-ring", "10m"});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parsed));
  EXPECT_EQ(std::get<ServerOptions>(parsed).live.record_ring.seconds, 600.0);
  EXPECT_EQ(exit_code({"--record-ring", "10m"}), 2);
  EXPECT_EQ(exit_code({"--record", "a.scree", "--record-ring", "10"}), 2);
}

TEST(ServerOptions, one_file_for_two_purposes_is_refused_before_it_is_made) {
  TestFolder folder;
  const std::string file = folder / "x", link = folder / "link", there = folder / "there";
  EXPECT_EQ(exit_code({"--world", file.c_str(), "--events", file.c_str()}), 2);
  EXPECT_EQ(exit_code({"--record", file.c_str(), "--world", (folder / "./x").c_str()}), 2);
  EXPECT_EQ(exit_code({"--report", file.c_str(), "--trace", file.c_str()}), 2);
  EXPECT_FALSE(std::filesystem::exists(file));
  std::ofstream(there) << "x";
  std::filesystem::create_symlink(there, link);
  EXPECT_EQ(exit_code({"--events", link.c_str(), "--report", there.c_str()}), 2);
  EXPECT_EQ(exit_code({"--events", "/dev/null", "--report", "/dev/null"}), -1) << "takes anything";
}

TEST(ServerOptions, help_is_no_mistake_and_a_mistake_is_code_2) {
  EXPECT_EQ(exit_code({"--help"}), 0);
  EXPECT_EQ(exit_code({"--no-such-option"}), 2);
  EXPECT_EQ(exit_code({"--port", "123456"}), 2);
  EXPECT_EQ(exit_code({"--terrain", "swamp"}), 2);
  EXPECT_EQ(exit_code({"--tick-rate", "0"}), 2);
  EXPECT_EQ(exit_code({"--tick-rate", "100000"}), 2);
  EXPECT_EQ(exit_code({"--voxel-size", "0.05"}), 2);
  EXPECT_EQ(exit_code({"--voxel-size", "nan"}), 2);
  EXPECT_EQ(exit_code({"--pieces-max", "0"}), 2);
  EXPECT_EQ(exit_code({"--record", "a", "--replay", "b"}), 2);
  EXPECT_EQ(exit_code({"--replay", "r", "--terrain", "flat"}), 2) << "the recording has its own";
  EXPECT_EQ(exit_code({"--tick-rate", "30", "--replay", "r"}), 2);
  EXPECT_EQ(exit_code({"--loop"}), 2);
  EXPECT_EQ(exit_code({"--net-threads", "65"}), 2);
  EXPECT_EQ(exit_code({"--sim-threads", "65"}), 2);
  EXPECT_EQ(exit_code({"--impacts", "perhaps"}), 2);
  EXPECT_EQ(exit_code({"--admin-token", "short"}), 2);
  EXPECT_EQ(exit_code({"--admin-token-file", "/no/such/file"}), 2);
  EXPECT_EQ(exit_code({"--admin-token", "long enough", "--admin-token-file", "a"}), 2);
  EXPECT_EQ(exit_code({"--config", "/no/such/file.toml"}), 2);
}

TEST(ServerOptions, a_ground_file_is_the_terrain_and_what_is_none_is_a_mistake) {
  const TestFolder folder;
  const std::string path = folder / "hills.ground";
  const auto written = written_ground(path, 40, 30, 2.0F);
  const auto parsed = parse({"--ground", path.c_str(), "--voxel-size", "0.5"});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parsed));
  const TerrainSource& terrain = std::get<ServerOptions>(parsed).live.world.terrain;
  ASSERT_NE(terrain.heights, nullptr);
  EXPECT_EQ(terrain.heights->layout(), written->layout());
  EXPECT_EQ(std::get<ServerOptions>(parsed).live.world.ground, written->name());
  EXPECT_EQ(terrain.voxel_size_m, 0.5F);
  EXPECT_EQ(exit_code({"--ground", path.c_str(), "--terrain", "flat"}), 2);
  EXPECT_EQ(exit_code({"--ground", "/no/such/file.ground"}), 2);
}

TEST(ServerOptions, a_world_is_kept_as_durability_and_autosave_say) {
  const auto kept = [](std::vector<const char*> more) {
    more.insert(more.begin(), {"--world", "a.world"});
    const auto parsed = parse(more);
    const auto* options = std::get_if<ServerOptions>(&parsed);
    return options == nullptr ? LiveConfig() : options->live;
  };
  EXPECT_EQ(kept({}).world_path, "a.world");
  EXPECT_EQ(kept({}).durability, Durability::second);
  EXPECT_EQ(kept({"--durability", "tick"}).durability, Durability::tick);
  const LiveConfig off = kept({"--durability", "off", "--autosave", "2.5"});
  EXPECT_EQ(off.durability, Durability::off);
  EXPECT_EQ(off.autosave_s, 2.5);
  EXPECT_EQ(kept({"--durability", "off", "--autosave", "0"}).autosave_s, 0.0);
  EXPECT_EQ(exit_code({"--world", "a.world", "--durability", "sometimes"}), 2);
  for (const char* seconds : {"-1", "nan", "1e9", "soon"})
    EXPECT_EQ(exit_code({"--world", "a.world", "--autosave", seconds}), 2) << seconds;
  EXPECT_EQ(exit_code({"--durability", "tick"}), 2) << "of no world";
  EXPECT_EQ(exit_code({"--autosave", "5"}), 2) << "of no world";
}

TEST(ServerOptions, settings_that_are_numbers_are_options_within_their_bounds) {
  const auto parsed = parse({"--pieces-max", "500", "--sessions-max", "9", "--requests-per-second", "0.5"});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parsed));
  const WorldConfig& world = std::get<ServerOptions>(parsed).live.world;
  EXPECT_EQ(world.pieces_max, 500U);
  EXPECT_EQ(world.service, (ServiceLimits{9, 0.5}));
  for (const char* pieces : {"0", "20001", "many", "1.5"}) EXPECT_EQ(exit_code({"--pieces-max", pieces}), 2);
  EXPECT_EQ(exit_code({"--requests-per-second", "0"}), 2);
}

TEST(ServerOptions, support_without_islands_is_a_mistake_in_either_order) {
  EXPECT_EQ(exit_code({"--islands", "false", "--support", "true"}), 2);
  EXPECT_EQ(exit_code({"--support", "true", "--islands", "false"}), 2);
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parse({"--support", "true"})));
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parse({"--islands", "false", "--support", "false"})));
}

TEST(ServerOptions, a_variable_that_says_no_needs_nothing) {
  ::setenv("SCREE_LOOP", "false", 1);
  EXPECT_TRUE(std::holds_alternative<ServerOptions>(parse({})));
  ::setenv("SCREE_LOOP", "true", 1);
  EXPECT_EQ(exit_code({}), 2) << "there is no replay";
  ::unsetenv("SCREE_LOOP");
}

TEST(ServerOptions, flag_wins_over_file_over_environment) {
  const auto path =
      std::filesystem::temp_directory_path() / ("scree_options_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(path) << "sessions-max = 7\ntick-rate = 20\nislands = false\nsim-threads = 3\n";
  ::setenv("SCREE_PORT", "5002", 1);
  ::setenv("SCREE_SESSIONS_MAX", "3", 1);
  ::setenv("SCREE_DENTS", "false", 1);
  const std::string file = path.string();
  const auto parsed = parse({"--config", file.c_str(), "--tick-rate", "40"});
  ::unsetenv("SCREE_PORT");
  ::unsetenv("SCREE_SESSIONS_MAX");
  ::unsetenv("SCREE_DENTS");
  std::filesystem::remove(path);
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(parsed));
  const LiveConfig& live = std::get<ServerOptions>(parsed).live;
  EXPECT_EQ(live.world.service.sessions_max, 7U);
  EXPECT_EQ(live.net.port, 5002);
  EXPECT_EQ(live.world.tick_rate_hz, 40U);
  EXPECT_EQ(live.sim_threads, 3U);
  EXPECT_FALSE(live.world.methods.islands);
  EXPECT_FALSE(live.world.methods.dents);
  EXPECT_TRUE(live.world.methods.impacts);
}

TEST(ServerOptions, admin_token_comes_from_a_file_or_the_command_line) {
  const auto path =
      std::filesystem::temp_directory_path() / ("scree_options_token_" + std::to_string(::getpid()));
  std::ofstream(path) << "token-in-a-file\n";
  const std::string file = path.string();
  const auto from_file = parse({"--admin-token-file", file.c_str()});
  std::filesystem::remove(path);
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(from_file));
  EXPECT_EQ(std::get<ServerOptions>(from_file).live.net.admin_token, "token-in-a-file");
  const auto from_line = parse({"--admin-token", "token-on-the-line"});
  ASSERT_TRUE(std::holds_alternative<ServerOptions>(from_line));
  EXPECT_EQ(std::get<ServerOptions>(from_line).live.net.admin_token, "token-on-the-line");
}

TEST(ServerOptions, a_variable_names_the_file_of_options_unless_a_flag_does) {
  const TestFolder folder;
  const std::string one = folder / "one.toml", two = folder / "two.toml";
  std::ofstream(one) << "sessions-max = 7\n";
  std::ofstream(two) << "sessions-max = 9\n";
  const auto sessions_max = [](std::initializer_list<const char*> arguments) {
    const auto parsed = parse(arguments);
    return std::holds_alternative<ServerOptions>(parsed)
               ? std::get<ServerOptions>(parsed).live.world.service.sessions_max
               : 0;
  };
  ::setenv("SCREE_CONFIG", one.c_str(), 1);
  EXPECT_EQ(sessions_max({}), 7U);
  const std::string flag = "--config=" + two;
  EXPECT_EQ(sessions_max({"--config", two.c_str()}), 9U);
  EXPECT_EQ(sessions_max({flag.c_str()}), 9U);
  EXPECT_EQ(sessions_max({"--sessions-max", "5"}), 5U);
  ::setenv("SCREE_CONFIG", (folder / "none.toml").c_str(), 1);
  EXPECT_EQ(exit_code({}), 2);
  ::setenv("SCREE_CONFIG", "", 1);
  EXPECT_EQ(sessions_max({"--sessions-max", "5"}), 5U);
  ::unsetenv("SCREE_CONFIG");
}

TEST(ServerOptions, access_is_configured_like_everything_else) {
  const auto access = [](std::vector<const char*> arguments) {
    const auto parsed = parse(std::move(arguments));
    EXPECT_TRUE(std::holds_alternative<ServerOptions>(parsed));
    return std::get<ServerOptions>(parsed).live.net.access;
  };
  EXPECT_EQ(access({}).anonymous, Role::builder) << "open, where nothing is said";
  EXPECT_EQ(access({"--token-key", "k"}).anonymous, std::nullopt) << "who has a key for tokens wants them";
  EXPECT_EQ(access({"--token-key", "k", "--anonymous", "viewer"}).anonymous, Role::viewer);
  EXPECT_EQ(access({"--anonymous", "none"}).anonymous, std::nullopt);
  ::setenv("SCREE_TLS_CERT", "c", 1);
  ::setenv("SCREE_ANONYMOUS", "carver", 1);
  const AccessConfig all = access({"--tls-key", "k", "--tls-required", "--token-key", "p", "--token-revoked",
                                   "r", "--world-name", "mine", "--bans", "b"});
  ::unsetenv("SCREE_TLS_CERT");
  ::unsetenv("SCREE_ANONYMOUS");
  EXPECT_EQ(all.tls_certificate_path, "c");
  EXPECT_EQ(all.tls_key_path, "k");
  EXPECT_TRUE(all.tls_required);
  EXPECT_EQ(all.token_key_path, "p");
  EXPECT_EQ(all.token_revoked_path, "r");
  EXPECT_EQ(all.anonymous, Role::carver);
  EXPECT_EQ(all.world, "mine");
  EXPECT_EQ(all.bans_path, "b");
  EXPECT_EQ(exit_code({"--tls-cert", "c"}), 2);
  EXPECT_EQ(exit_code({"--tls-required"}), 2);
  EXPECT_EQ(exit_code({"--token-revoked", "r"}), 2);
  EXPECT_EQ(exit_code({"--anonymous", "admin"}), 2);
}

TEST(ServerOptions, unknown_name_in_the_file_is_a_mistake) {
  const auto path =
      std::filesystem::temp_directory_path() / ("scree_options_bad_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(path) << "prot = 5001\n";
  const std::string file = path.string();
  EXPECT_EQ(exit_code({"--config", file.c_str()}), 2);
  std::filesystem::remove(path);
}

/// What a mistake is told by.
std::string words_for(std::vector<const char*> arguments) {
  ::testing::internal::CaptureStderr();
  const int code = exit_code(std::move(arguments));
  std::string words = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(code, 2) << words;
  return words;
}

TEST(ServerOptions, what_is_no_number_is_refused_at_the_start_by_its_range) {
  EXPECT_TRUE(holds(words_for({"--duration", "nan"}), "'nan' is not a number, 0 to 1000000000"));
  EXPECT_TRUE(holds(words_for({"--ticks", "-1"}), "--ticks: '-1' is not a whole number, 0 to "));
  EXPECT_TRUE(holds(words_for({"--port", "70000"}), "--port: '70000' is not a whole number, 0 to 65535"));
  for (const char* option : {"--wait-clients", "--seed", "--net-threads"})
    EXPECT_TRUE(holds(words_for({option, "-1"}), "'-1' is not a whole number")) << option;
  EXPECT_EQ(exit_code({"--replay", "r", "--speed", "nan"}), 2);
  EXPECT_EQ(exit_code({"--replay", "r", "--from", "-1"}), 2);
}

TEST(ServerOptions, a_second_configuration_file_is_a_mistake) {
  const std::string words = words_for({"--config", "one.toml", "--config", "two.toml"});
  EXPECT_TRUE(holds(words, "--config: ")) << words;
}

TEST(ServerOptions, nothing_after_an_option_is_a_mistake) {
  for (const char* option :
       {"--world", "--record", "--replay", "--ground", "--bans", "--admin-token", "--bind", "--config"}) {
    const std::string words = words_for({option, ""});
    EXPECT_TRUE(holds(words, "must not be empty")) << words;
  }
}

TEST(ServerOptions, reports_and_traces_are_tried_at_the_start) {
  for (const char* option : {"--report", "--trace"}) {
    const std::string words = words_for({option, "/no/such/folder/file.json"});
    EXPECT_TRUE(holds(words, std::string(option) + ": /no/such/folder/file.json cannot be written: No such"))
        << words;
  }
}

TEST(ServerOptions, a_mistake_in_the_file_is_told_with_file_and_line) {
  const TestFolder folder;
  const std::string file = folder / "server.toml";
  const auto words = [&](const std::string& text) {
    std::ofstream(file) << text;
    return words_for({"--config", file.c_str()});
  };
  EXPECT_TRUE(holds(words("tick-rate = 30\n\nprot = 5001\n"), file + ":3: there is no option 'prot'"));
  EXPECT_TRUE(holds(words("# a comment\nport = 70000\n"), file + ":2: --port: '70000' is not"));
  EXPECT_TRUE(holds(words("dents = true\nimpacts = perhaps\n"), file + ":2: "));
  EXPECT_TRUE(holds(words("voxel-size = nan\n"), file + ":1: --voxel-size"));
  EXPECT_TRUE(holds(words("port = 1\n[server]\nseed = 3\n"), file + ":2: options must not be in a section"));
  std::string deep = "[a";
  for (int i = 0; i < 40'000; ++i) deep += ".b";
  EXPECT_TRUE(holds(words(deep + "]\n"), file + ":1: options must not be in a section"));
  EXPECT_TRUE(holds(words("a.b.c = 1\n"), file + ":1: options must not be in a section"));
  EXPECT_TRUE(holds(words("proxy = [\"127.0.0.1\"\n"), file + ":1: a list that does not end"));
  EXPECT_TRUE(holds(words("seed = 3\nport = [1\n"), file + ":2: a list that does not end"));
  EXPECT_TRUE(holds(words("seed = 3\nport =\n"), file + ":2: --port: "));
  EXPECT_TRUE(
      holds(words("web-origin = [\n'https://a.example'\n]\nprot = 5001\n"), file + ":4: there is no"));
  const std::string together = words("support = true\nislands = false\n");
  EXPECT_TRUE(holds(together, "support needs islands")) << "no line by itself: " << together;
}

TEST(ServerOptions, a_file_of_options_is_a_file_and_no_longer_than_one) {
  const TestFolder folder;
  const std::string file = folder / "server.toml";
  const auto words = [&](const std::string& text) {
    std::ofstream(file) << text;
    return words_for({"--config", file.c_str()});
  };
  const auto lines = [](const std::string& line, size_t times) {
    std::string all;
    for (size_t i = 0; i < times; ++i) all += line;
    return all;
  };
  // A hundred thousand equal lines took 30 s, and four thousand 8 s.
  EXPECT_TRUE(
      holds(words(lines("port = 4177\n", 100'000)), file + ": more than 256 KiB are no file of options"));
  EXPECT_TRUE(holds(words(lines("port = 1\n", 5'000)), "(limits.config_lines_max)"));
  EXPECT_TRUE(holds(words(lines("port = 1\n", 4'000)), "(limits.config_values_max)"));
  EXPECT_FALSE(words(lines("port = 1\n", 200)).empty());
  EXPECT_FALSE(words("web-origin = [" + lines("'a',", 1'000) + "]\n").empty());
  std::ofstream(file) << lines("# a remark\n", 4'000) + "port = 1\n";
  EXPECT_EQ(exit_code({"--config", file.c_str()}), -1) << "remarks are no mistakes";
  const std::string pipe = folder / "pipe.toml";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(holds(words_for({"--config", pipe.c_str()}), pipe + ": it is a pipe, not a file"));
  EXPECT_TRUE(holds(words_for({"--config", "/dev/zero"}), "it is a device, not a file"));
}

TEST(ServerOptions, a_token_comes_from_no_pipe) {
  const TestFolder folder;
  const std::string pipe = folder / "token";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_TRUE(holds(words_for({"--admin-token-file", pipe.c_str()}), pipe + ": it is a pipe, not a file"));
}

}  // namespace
}  // namespace scree
