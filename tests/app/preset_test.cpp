// Presets of the server's options: what each gives, and what overrides it.
#include "shared/base/preset.h"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>

#include "server/app/server_options.h"
#include "server/world/settings.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

std::variant<ServerOptions, int> parse_preset(std::vector<std::string> arguments) {
  std::vector<const char*> pointers{"scree-server"};
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  return parse_server_options(static_cast<int>(pointers.size()), pointers.data());
}

/// The configuration by options that must be accepted.
LiveConfig live_by(const std::vector<std::string>& arguments) {
  const auto parsed = parse_preset(arguments);
  const auto* options = std::get_if<ServerOptions>(&parsed);
  EXPECT_NE(options, nullptr);
  return options == nullptr ? LiveConfig() : options->live;
}

/// A value of the table as the options hold it.
std::string value_in(const LiveConfig& live, std::string_view name) {
  if (name == "tick-rate") return std::to_string(live.world.tick_rate_hz);
  if (name == "sim-threads") return std::to_string(live.sim_threads);
  if (name == "net-threads") return std::to_string(live.net.net_threads);
  for (const SettingValue& setting : print(live.world))
    if (setting.name == name) return setting.value;
  return "none of these";
}

TEST(Preset, gives_all_values_of_its_column) {
  for (const Preset preset : all_kinds<Preset>) {
    const LiveConfig live = live_by({"--preset", std::string(name_of(preset))});
    EXPECT_TRUE(validate(live.world));
    for (const PresetOption& row : server_preset_options)
      EXPECT_EQ(value_in(live, row.name), row.of(preset)) << name_of(preset) << ": " << row.name;
  }
}

TEST(Preset, any_one_of_its_values_may_be_said_otherwise) {
  for (const Preset preset : all_kinds<Preset>)
    for (const PresetOption& said : server_preset_options)
      for (const Preset other : all_kinds<Preset>) {
        const LiveConfig live = live_by({"--preset", std::string(name_of(preset)),
                                         "--" + std::string(said.name), std::string(said.of(other))});
        for (const PresetOption& row : server_preset_options)
          EXPECT_EQ(value_in(live, row.name), row.of(row.name == said.name ? other : preset));
      }
}

TEST(Preset, flag_file_and_environment_stand_over_it) {
  const TestFolder folder;
  const std::string file = folder / "server.toml";
  std::ofstream(file) << "preset = \"laptop\"\npieces-max = 7\n";
  ::setenv("SCREE_WORK_PERCENT", "33", 1);
  const LiveConfig live = live_by({"--config", file, "--tick-rate", "50"});
  ::unsetenv("SCREE_WORK_PERCENT");
  EXPECT_EQ(live.world.tick_rate_hz, 50U);
  EXPECT_EQ(live.world.pieces_max, 7U);
  EXPECT_EQ(live.world.work_percent, 33U);
  EXPECT_EQ(value_in(live, "memory-max"), "1024") << "the preset's, which nobody said otherwise";
  EXPECT_EQ(value_in(live_by({"--config", file, "--preset", "dedicated"}), "memory-max"), "8192");
}

TEST(Preset, comes_by_the_environment_too) {
  ::setenv("SCREE_PRESET", "laptop", 1);
  const LiveConfig live = live_by({});
  ::unsetenv("SCREE_PRESET");
  EXPECT_EQ(live.world.tick_rate_hz, 30U);
  EXPECT_EQ(live_by({}).world, WorldConfig{}) << "none by default";
}

TEST(Preset, goes_with_a_replay_which_has_its_own_tick_rate) {
  EXPECT_EQ(live_by({"--preset", "laptop", "--replay", "r"}).replay.path, "r");
}

TEST(Preset, an_unknown_one_is_a_mistake_that_names_those_there_are) {
  testing::internal::CaptureStderr();
  const auto parsed = parse_preset({"--preset", "toaster"});
  const std::string said = testing::internal::GetCapturedStderr();
  ASSERT_TRUE(std::holds_alternative<int>(parsed));
  EXPECT_EQ(std::get<int>(parsed), 2);
  for (const Preset preset : all_kinds<Preset>)
    EXPECT_NE(said.find(name_of(preset)), std::string::npos) << said;
}

TEST(Preset, help_says_every_value) {
  testing::internal::CaptureStdout();
  const auto parsed = parse_preset({"--help"});
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_EQ(std::get<int>(parsed), 0);
  for (const Preset preset : all_kinds<Preset>) {
    EXPECT_NE(said.find(std::string(name_of(preset)) + ": " + std::string(traits_of(preset).machine)),
              std::string::npos)
        << said;
    const std::string line = describe_presets({&preset, 1}, server_preset_options);
    for (const PresetOption& row : server_preset_options)
      EXPECT_NE(line.find(std::string(row.name) + " " + std::string(row.of(preset))), std::string::npos)
          << line << row.name;
  }
}

TEST(Preset, its_settings_change_while_the_world_runs) {
  World world(live_by({"--preset", "laptop"}).world);
  const Command change{0, 0, SettingsRequest{{{"recombine", "sphere"}, {"pieces-max", "1234"}}}};
  const auto delta = world.step({&change, 1});
  ASSERT_EQ(delta->replies.size(), 1U);
  EXPECT_EQ(delta->replies.front().refusal, "");
  EXPECT_EQ(world.config().methods.recombine, Recombination::sphere);
  EXPECT_EQ(world.config().pieces_max, 1234U);
  EXPECT_EQ(world.config().work_percent, 40U) << "the rest stays the preset's";
}

/// The rows of the table in docs/host.md: the option, and a value by each preset.
std::vector<std::vector<std::string>> stated_presets() {
  std::ifstream page(SCREE_SOURCE_DIR "/docs/host.md");
  std::string line;
  while (std::getline(page, line) && line != "| option | `laptop` | `desktop` | `dedicated` |") continue;
  std::vector<std::vector<std::string>> rows;
  for (std::getline(page, line); std::getline(page, line) && line.starts_with("| ");) {
    std::vector<std::string>& row = rows.emplace_back();
    for (size_t at = 2; at < line.size();) {
      const size_t end = line.find(" |", at);
      if (end == std::string::npos) break;
      row.push_back(line.substr(at, end - at));
      at = end + 3;
    }
  }
  return rows;
}

TEST(Preset, the_page_states_every_value) {
  std::vector<std::vector<std::string>> wanted;
  const auto add = [&](const std::string& whose, std::span<const PresetOption> options) {
    for (const PresetOption& option : options) {
      std::vector<std::string>& row = wanted.emplace_back();
      row.push_back(whose + "`--" + std::string(option.name) + "`");
      for (const std::string_view value : option.values) row.emplace_back(value.empty() ? "–" : value);
    }
  };
  add("", server_preset_options);
  add("viewer: ", viewer_preset_options);
  EXPECT_EQ(stated_presets(), wanted);
}

}  // namespace
}  // namespace scree
