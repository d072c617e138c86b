// What the viewer keeps, what its tools ask for, and what a gamepad does.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

#include "client/render/grid/grid_shape.h"
#include "client/viewer/input/gamepad.h"
#include "client/viewer/viewing/settings.h"
#include "client/viewer/window/history.h"
#include "content/builtin_palette.h"
#include "shared/base/limits.h"

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
  settings.hud = {Telling::all, true, true, false, true};
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

TEST(Tool, every_shape_is_within_the_servers_limits) {
  for (const ToolKind kind : all_kinds<ToolKind>)
    for (const float radius_m : {tool_radius_min_m, 2.0F, tool_radius_max_m}) {
      Tool tool;
      tool.kind = kind;
      tool.radius_m = radius_m;
      const glm::vec3 direction = glm::normalize(glm::vec3(1, -2, 3));
      const auto carve = std::get<CarveRequest>(request_of(tool, {1.0F, 2.0F, 3.0F}, direction, 7));
      EXPECT_TRUE(validate(carve.shape));
      EXPECT_LE(reach_of(carve.shape), limits::edit_reach_max_m + 1e-4F) << name_of(kind) << " " << radius_m;
      EXPECT_GE(reach_of(carve.shape), limits::edit_reach_min_m);
      EXPECT_LT(distance(carve.shape, carve.impact_m), 0.0F) << "the surface is opened";
      EXPECT_LE(carve.seeds, limits::seeds_max);
    }
}

TEST(Tool, what_is_filled_stands_on_the_rock_and_what_is_painted_is_in_it) {
  const glm::vec3 hit_m(1.0F, 2.0F, 3.0F), down(0.0F, -1.0F, 0.0F);
  Tool tool;
  change(tool, Action::next_use);
  const auto fill = std::get<FillRequest>(request_of(tool, hit_m, down, 1));
  EXPECT_LT(distance(fill.shape, hit_m), 0.0F) << "it touches";
  EXPECT_GT(centre_of(fill.shape).y, hit_m.y) << "and is mostly outside";
  change(tool, Action::next_use);
  change(tool, Action::next_material, builtin_palette());
  const auto paint = std::get<PaintRequest>(request_of(tool, hit_m, down, 1, builtin_palette()));
  EXPECT_EQ(paint.material, material::soil);
  EXPECT_LT(distance(paint.shape, hit_m), 0.0F);
  change(tool, Action::next_use);
  const auto dig = std::get<DigRequest>(request_of(tool, hit_m, down, 1, builtin_palette()));
  EXPECT_EQ(dig.store, StoreName{});
  EXPECT_LT(centre_of(dig.shape).y, hit_m.y);
  change(tool, Action::next_use);
  const auto place = std::get<PlaceRequest>(request_of(tool, hit_m, down, 1, builtin_palette()));
  EXPECT_EQ(place.material, material::soil);
  EXPECT_GT(centre_of(place.shape).y, hit_m.y);
  change(tool, Action::next_use);
  EXPECT_EQ(tool.use, ToolUse::carve);
}

TEST(Tool, materials_are_known_by_name_and_one_that_the_world_lacks_is_its_first) {
  const Palette& palette = builtin_palette();
  Tool tool;
  tool.use = ToolUse::fill;
  EXPECT_EQ(material_of(tool, palette), std::nullopt) << "as the ground";
  for (const MaterialRow& row : palette.rows) {
    change(tool, Action::next_material, palette);
    EXPECT_EQ(tool.material, row.name);
    EXPECT_EQ(std::get<FillRequest>(request_of(tool, {}, {0.0F, -1.0F, 0.0F}, 1, palette)).material,
              palette.named(row.name));
  }
  change(tool, Action::next_material, palette);
  EXPECT_EQ(tool.material, "");
  tool.use = ToolUse::paint;
  EXPECT_EQ(material_of(tool, palette), Material{}) << "paint is always of one";
  tool.material = "brick";
  EXPECT_EQ(material_of(tool, *plain_palette()), Material{});
  EXPECT_EQ(tool.material, "brick") << "for the next world";
}

TEST(Tool, actions_stay_within_the_ranges) {
  Tool tool;
  for (const Action action : {Action::larger, Action::stronger, Action::more_seeds})
    for (int i = 0; i < 100; ++i) change(tool, action);
  EXPECT_EQ(tool.radius_m, tool_radius_max_m);
  EXPECT_EQ(tool.blast_speed_m_s, limits::blast_speed_max_m_s);
  EXPECT_EQ(tool.seeds, tool_seeds_max);
  for (const Action action : {Action::smaller, Action::weaker, Action::fewer_seeds})
    for (int i = 0; i < 100; ++i) change(tool, action);
  EXPECT_EQ(tool.radius_m, tool_radius_min_m);
  EXPECT_EQ(tool.blast_speed_m_s, 0.0F);
  EXPECT_GE(seeds_of(tool), 1U);
  change(tool, Action::box);
  change(tool, Action::next_tool);
  EXPECT_EQ(tool.kind, ToolKind::tunnel);
  change(tool, Action::next_tool);
  EXPECT_EQ(tool.kind, ToolKind::crater);
  change(tool, Action::next_tool);
  EXPECT_EQ(tool.kind, ToolKind::sphere);
}

TEST(Tool, is_told_with_what_it_does_and_units) {
  Tool tool;
  EXPECT_EQ(describe(tool), "carve: crater, radius 2.00 m, blast 6 m/s, natural, about 20 pieces");
  tool.use = ToolUse::fill;
  tool.kind = ToolKind::box;
  EXPECT_EQ(describe(tool), "fill: box, radius 2.00 m");
  tool.use = ToolUse::paint;
  tool.material = "ice";
  EXPECT_EQ(describe(tool), "paint: box, radius 2.00 m, ice");
}

TEST(Tool, patterns_and_tools_go_round_and_none_is_offered_that_needs_points) {
  Tool tool;
  std::set<SeedPattern> patterns;
  for (size_t i = 0; i < 2 * kind_count<SeedPattern>; ++i) {
    change(tool, Action::next_pattern);
    EXPECT_TRUE(asks_no_points(tool.pattern)) << name_of(tool.pattern);
    patterns.insert(tool.pattern);
  }
  EXPECT_EQ(patterns.size(), pointless_patterns.size());
  tool.pattern = SeedPattern::authored;
  change(tool, Action::next_pattern);
  EXPECT_TRUE(asks_no_points(tool.pattern));
  std::set<ToolKind> tools;
  for (size_t i = 0; i < kind_count<ToolKind>; ++i) {
    change(tool, Action::next_tool);
    tools.insert(tool.kind);
  }
  EXPECT_EQ(tools.size(), kind_count<ToolKind>);
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
