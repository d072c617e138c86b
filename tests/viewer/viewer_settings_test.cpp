// What the viewer keeps, and what a gamepad does.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "client/render/grid/grid_shape.h"
#include "client/viewer/input/gamepad.h"
#include "client/viewer/viewing/settings.h"
#include "client/viewer/window/history.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

class SettingsTest : public testing::Test {
 protected:
  SettingsTest()
      : folder_(fs::path(testing::TempDir()) /
                ("scree_settings_" +
                 std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(folder_);
    ::setenv("XDG_CONFIG_HOME", folder_.c_str(), 1);
  }
  ~SettingsTest() override { fs::remove_all(folder_); }

  void write(const std::string& text) const {
    fs::create_directories(fs::path(settings_file()).parent_path());
    std::ofstream(settings_file()) << text;
  }
  static std::string written() {
    std::ostringstream text;
    text << std::ifstream(settings_file()).rdbuf();
    return text.str();
  }

  fs::path folder_;
};

TEST_F(SettingsTest, lie_where_xdg_says) {
  EXPECT_EQ(settings_file(), (folder_ / "scree" / "viewer.json").string());
  ::setenv("XDG_CONFIG_HOME", "relative", 1);
  ::setenv("HOME", "/home/somebody", 1);
  EXPECT_EQ(settings_file(), "/home/somebody/.config/scree/viewer.json");
  ::unsetenv("HOME");
  EXPECT_EQ(settings_file(), "");
}

TEST_F(SettingsTest, what_changed_is_kept_and_what_a_flag_said_is_not) {
  const SettingsFile first(settings_file());
  EXPECT_EQ(first.loaded(), Settings{});
  Settings start;
  start.width = 333;  // by a flag
  start.tool.pattern = SeedPattern::even;
  Settings end = start;
  end.hud.graphs = true;
  end.tool.kind = ToolKind::tunnel;
  end.quality = Quality::low;
  end.predict = false;
  end.particles = false;
  end.sound = false;
  first.save(start, end);

  const SettingsFile second(settings_file());
  EXPECT_EQ(second.loaded().width, 1280);
  EXPECT_TRUE(second.loaded().hud.graphs);
  EXPECT_EQ(second.loaded().tool.kind, ToolKind::tunnel);
  EXPECT_EQ(second.loaded().tool.pattern, Tool().pattern);
  EXPECT_EQ(second.loaded().quality, Quality::low);
  EXPECT_FALSE(second.loaded().predict);
  EXPECT_FALSE(second.loaded().particles);
  EXPECT_FALSE(second.loaded().sound);
}

TEST_F(SettingsTest, a_broken_file_is_ignored_and_kept) {
  for (const std::string broken :
       {"{\"width\": 12", "[]", R"({"width": "wide"})", R"({"width": -5})", R"({"method": "magic"})",
        R"({"tool": "spoon"})", R"({"pattern": "authored"})", R"({"panel": 1})", R"({"radius_m": 1e30})",
        R"({"grid_resolution": 33})", R"({"grid_scale": 3})", R"({"grid_spacing": "odd"})",
        R"({"quality": "best"})"}) {
    write(broken);
    testing::internal::CaptureStderr();
    const SettingsFile saved(settings_file());
    EXPECT_NE(testing::internal::GetCapturedStderr().find("warning"), std::string::npos) << broken;
    EXPECT_EQ(saved.loaded(), Settings{});
    Settings end;
    end.width = 500;
    saved.save(Settings{}, end);
    EXPECT_EQ(written(), broken);
  }
}

TEST_F(SettingsTest, text_is_understood_again) {
  Settings settings;
  settings.width = 801;
  settings.method = all_methods().front().name;
  settings.method_options = values_of(GridShape{64, 4, GridSpacing::growing});
  settings.tool = {ToolKind::box, ToolUse::paint, "ice", 3.25F, 12.0F, SeedPattern::uniform, 40};
  settings.hud = {Telling::all, true, true, false, true, true};
  settings.hand = {75.0F, 2.5F, 1.5F};
  settings.overlay = {true, false, true, false, true};
  settings.particles = false;
  settings.predict = false;
  settings.sound = false;
  settings.quality = Quality::high;
  const Result<Settings> again = parse_settings(to_text(settings));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(*again, settings);
}

TEST_F(SettingsTest, deep_nesting_is_refused) {
  constexpr size_t depth = 160000;
  const Result<Settings> settings =
      parse_settings(R"({"method": )" + std::string(depth, '[') + std::string(depth, ']') + "}");
  ASSERT_FALSE(settings);
  EXPECT_NE(settings.error().message.find("json_depth_max"), std::string::npos) << settings.error().message;
}

TEST_F(SettingsTest, flags_win) {
  Settings settings;
  settings.width = 640;
  settings.height = 360;
  settings.quality = Quality::medium;
  settings.method_options = values_of(GridShape{64, 4, GridSpacing::growing});
  ViewerOptions options;
  options.given.method_options = {"grid-scale"};
  options.given.size = true;
  options.width = 100;
  apply_settings(settings, options);
  EXPECT_EQ(options.width, 100);
  EXPECT_EQ(options.quality, Quality::medium);
  EXPECT_EQ(grid_shape_of(options.method_options), (GridShape{64, GridShape().scale, GridSpacing::growing}));
  EXPECT_TRUE(options.predict);
  settings.predict = false;
  apply_settings(settings, options);
  EXPECT_FALSE(options.predict);
  options.predict = options.given.predict = true;
  apply_settings(settings, options);
  EXPECT_TRUE(options.predict);
}

TEST(Gamepad, sticks_fly_and_worn_ones_rest) {
  Gamepad pad;
  PadState state;
  state.left_x = 0.1F;  // worn
  state.left_y = -1.0F;
  state.right_x = 1.0F;
  FlyInput fly;
  pad.step(state, 0.1F, fly);
  EXPECT_EQ(fly.move.x, 0.0F);
  EXPECT_FLOAT_EQ(fly.move.z, 1.0F);
  EXPECT_GT(fly.turn.x, 0.0F);
  EXPECT_FALSE(fly.fast);
}

TEST(Gamepad, buttons_act_once_when_they_go_down) {
  Gamepad pad;
  PadState state;
  FlyInput fly;
  state.buttons = 1U;  // A
  state.right_trigger = 1.0F;
  EXPECT_EQ(pad.step(state, 0.1F, fly), std::vector{Action::next_tool});
  EXPECT_TRUE(pad.struck());
  EXPECT_TRUE(pad.step(state, 0.1F, fly).empty());
  EXPECT_FALSE(pad.struck());
}

TEST(History, is_a_ring_with_its_mean) {
  History history;
  EXPECT_EQ(history.mean(), 0.0F);
  for (size_t i = 0; i < History::length + 10; ++i) history.add(i < 10 ? 1000.0F : 2.0F);
  EXPECT_EQ(history.mean(), 2.0F);
  EXPECT_EQ(history.worst(), 2.0F);
  EXPECT_EQ(history.offset(), 10);
}

}  // namespace
}  // namespace scree
