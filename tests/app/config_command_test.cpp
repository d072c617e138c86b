// Where options come from, what `config print` and `config check` say, and what a file that is read again
// changes.
#include "server/app/config_command.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/app/config_reload.h"
#include "tests/support/captured_log.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

class ConfigTest : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const char* name : {"SCREE_REACH", "SCREE_SIGHT", "SCREE_ADMIN_TOKEN", "SCREE_CONFIG"})
      ::unsetenv(name);
  }
  void write(const std::string& text) const { std::ofstream(file) << text; }
  static ServerOptions read(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "scree-server");
    auto found = read_server_options(static_cast<int>(arguments.size()), arguments.data(), OptionsUse::look);
    EXPECT_TRUE(std::holds_alternative<ServerOptions>(found)) << std::get<OptionsEnd>(found).err;
    return std::holds_alternative<ServerOptions>(found) ? std::get<ServerOptions>(found) : ServerOptions();
  }
  static OptionValue named(const std::vector<OptionValue>& values, const std::string& name) {
    const auto found = std::ranges::find(values, name, &OptionValue::name);
    EXPECT_NE(found, values.end()) << name;
    return found == values.end() ? OptionValue() : *found;
  }
  static std::string from(const std::vector<OptionValue>& values, const std::string& name) {
    const OptionValue value = named(values, name);
    return std::string(name_of(value.source)) + " " + value.text();
  }
  int command(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), {"scree-server", "config"});
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int code = config_command(static_cast<int>(arguments.size()), arguments.data());
    out = ::testing::internal::GetCapturedStdout();
    err = ::testing::internal::GetCapturedStderr();
    return code;
  }

  TestFolder folder;
  std::string file = folder / "server.toml";
  std::string out, err;
};

TEST_F(ConfigTest, every_option_says_where_its_value_comes_from) {
  write("pieces-max = 700\nproxy = [\"127.0.0.1\", \"10.0.0.0/8\"]\nreach = 20\nport = 1\n");
  ::setenv("SCREE_REACH", "30", 1);
  ::setenv("SCREE_SIGHT", "true", 1);
  const auto values = read({"--config", file.c_str(), "--port=0", "--preset", "laptop"}).values;
  EXPECT_EQ(from(values, "port"), "flag 0") << "over the file";
  EXPECT_EQ(from(values, "reach"), "file 20") << "over the environment";
  EXPECT_EQ(from(values, "pieces-max"), "file 700") << "over the preset";
  EXPECT_EQ(from(values, "sight"), "environment true");
  EXPECT_EQ(from(values, "sessions-max"), "preset 8");
  EXPECT_EQ(from(values, "props-max"), "default 1000");
  EXPECT_EQ(from(values, "bind"), "default 127.0.0.1");
  EXPECT_EQ(from(values, "world"), "default ");
  EXPECT_EQ(from(values, "proxy"), "file 127.0.0.1,10.0.0.0/8");
  EXPECT_TRUE(named(values, "proxy").is_list);
  ::setenv("SCREE_CONFIG", file.c_str(), 1);
  EXPECT_EQ(from(read({"-p", "0"}).values, "port"), "flag 0");
  EXPECT_EQ(from(read({}).values, "config"), "environment " + file);
}

TEST_F(ConfigTest, print_shows_all_options_and_no_secret) {
  write("admin-token = \"of-the-file-alone\"\n");
  ASSERT_EQ(command({"print", "--config", file.c_str(), "--seed", "7"}), 0) << err;
  EXPECT_TRUE(holds(out, "\nseed ")) << out;
  EXPECT_FALSE(holds(out, "of-the-file-alone"));
  EXPECT_TRUE(holds(out, "(not shown)"));
  ASSERT_EQ(command({"print", "--json", "--config", file.c_str(), "--seed", "7"}), 0) << err;
  EXPECT_FALSE(holds(out, "of-the-file-alone"));
  const auto json = nlohmann::json::parse(out);
  EXPECT_EQ(json.at("seed"), (nlohmann::json{{"value", "7"}, {"from", "flag"}}));
  EXPECT_EQ(json.at("admin-token"), (nlohmann::json{{"value", nullptr}, {"from", "file"}, {"secret", true}}));
  EXPECT_EQ(json.at("web-host").at("value"), nlohmann::json::array());
  EXPECT_EQ(json.at("world").at("value"), nullptr);
}

TEST_F(ConfigTest, print_makes_no_token_and_refuses_what_the_server_refuses) {
  const std::string token = folder / "admin.token";
  EXPECT_EQ(command({"print", "--admin-token-file", token.c_str(), "--make-admin-token"}), 0) << err;
  EXPECT_FALSE(std::filesystem::exists(token));
  EXPECT_EQ(command({"print", "--pieces-max", "0"}), 1);
  EXPECT_TRUE(holds(err, "pieces-max is 1 to 20000")) << err;
  EXPECT_EQ(command({"print", "--no-such-option"}), 1);
  EXPECT_EQ(command({}), 2);
  EXPECT_EQ(command({"show"}), 2);
  EXPECT_EQ(command({"--help"}), 0);
}

TEST_F(ConfigTest, check_names_the_line_that_is_wrong) {
  write("# a comment\nseed = 7\npieces-max = 700\n");
  EXPECT_EQ(command({"check", file.c_str()}), 0) << err;
  EXPECT_EQ(out, file + ": 2 options, no fault\n");
  write("seed = 7\n\npieces-max = 0\n");
  EXPECT_EQ(command({"check", file.c_str()}), 1);
  EXPECT_TRUE(holds(err, file + ":3: ")) << err;
  EXPECT_TRUE(holds(err, "pieces-max")) << err;
  write("seed = 7\npiece-max = 3\n");
  EXPECT_EQ(command({"check", file.c_str()}), 1);
  EXPECT_TRUE(holds(err, file + ":2: there is no option 'piece-max'")) << err;
  write("token-key = \"" + file + "\"\n");
  EXPECT_EQ(command({"check", file.c_str()}), 1) << "no key is in it";
  EXPECT_TRUE(holds(err, file)) << err;
  EXPECT_EQ(command({"check", (folder / "missing.toml").c_str()}), 1);
  EXPECT_EQ(command({"check"}), 2);
  EXPECT_EQ(command({"check", file.c_str(), "more"}), 2);
}

// ---- read again

TEST_F(ConfigTest, settings_that_changed_are_told_apart_from_what_holds_later) {
  write("pieces-max = 700\nreach = 20\nport = 0\nseed = 1\n");
  const auto options = read({"--config", file.c_str()});
  const std::vector<const char*> arguments{"scree-server", "--config", file.c_str()};
  ConfigReload config(static_cast<int>(arguments.size()), arguments.data(), options);
  auto changes = config.read();
  ASSERT_TRUE(changes && *changes) << changes.error().message;
  EXPECT_TRUE((*changes)->settings.empty() && (*changes)->later.empty()) << "nothing changed";
  write(
      "pieces-max = 900\nport = 4\nseed = 1\nimpacts = false\nlog = \"warn\"\nadmin-token = "
      "\"another-token\"\n");
  changes = config.read();
  ASSERT_TRUE(changes && *changes) << changes.error().message;
  auto settings = (*changes)->settings;
  std::ranges::sort(settings, {}, &SettingValue::name);
  EXPECT_EQ(settings, (SettingValues{{"impacts", "false"}, {"pieces-max", "900"}}));
  EXPECT_EQ((*changes)->level, "warn");
  const std::string later = testing::PrintToString((*changes)->later);
  EXPECT_TRUE(holds(later, "port is 4 now, which holds from the next start on")) << later;
  EXPECT_TRUE(holds(later, "reach is not told any more, and stays as it is")) << later;
  EXPECT_TRUE(holds(later, "admin-token is another one now")) << later;
  EXPECT_FALSE(holds(later, "another-token")) << "a secret is not logged";
  changes = config.read();
  ASSERT_TRUE(changes && *changes);
  EXPECT_TRUE((*changes)->settings.empty()) << "an administrator may have changed it since";
  EXPECT_EQ((*changes)->later.size(), 2U) << "port and token still wait";
  write("pieces-max = 0\n");
  changes = config.read();
  ASSERT_FALSE(changes);
  EXPECT_TRUE(holds(changes.error().message, file + ":1: ")) << changes.error().message;
  write("pieces-max = 900\nport = 0\nseed = 1\nimpacts = true\n");
  changes = config.read();
  ASSERT_TRUE(changes && *changes);
  EXPECT_EQ((*changes)->settings, (SettingValues{{"impacts", "true"}})) << "after a wrong file";
}

TEST_F(ConfigTest, without_a_file_nothing_is_read_again) {
  const std::vector<const char*> arguments{"scree-server", "--seed", "7"};
  ConfigReload config(3, arguments.data(), read({"--seed", "7"}));
  const auto changes = config.read();
  ASSERT_TRUE(changes);
  EXPECT_FALSE(changes->has_value());
}

TEST_F(ConfigTest, a_server_sets_what_it_is_told_as_a_command_of_its_own) {
  LiveConfig live;
  live.world.terrain = flat_terrain;
  live.sim_threads = 1;
  live.pacing = Pacing::by_hand;
  const CapturedLog log;
  auto server = LiveServer::start(live);
  ASSERT_TRUE(server) << server.error().message;
  (*server)->step_once();
  ASSERT_TRUE((*server)->change_settings({{"pieces-max", "321"}, {"impacts", "false"}}));
  ASSERT_TRUE((*server)->change_settings({{"pieces-max", "322"}})) << "the last one counts";
  (*server)->step_once();
  EXPECT_EQ((*server)->world()->config().pieces_max, 322U);
  EXPECT_FALSE((*server)->world()->config().methods.impacts);
  EXPECT_EQ((*server)->last_delta()->settings_by, 0U);
  EXPECT_EQ(log.count("are not changed"), 0U) << log.text();
  ASSERT_TRUE((*server)->change_settings({{"support", "true"}, {"islands", "false"}}));
  (*server)->step_once();
  EXPECT_FALSE((*server)->world()->config().methods.support) << "refused by the world, all of it";
  EXPECT_TRUE((*server)->world()->config().methods.islands);
  EXPECT_EQ(log.count("are not changed: support needs islands"), 1U) << log.text();
}

}  // namespace
}  // namespace scree
