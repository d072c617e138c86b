// What a person's tool asks for, the button that repeats it, and what is said of it.
#include "client/viewer/input/tool.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <set>

#include "client/viewer/input/repeat.h"
#include "client/viewer/session/hints.h"
#include "client/viewer/session/refusal_words.h"
#include "content/builtin_palette.h"
#include "shared/base/limits.h"
#include "shared/operation/operation.h"

namespace scree {
namespace {

TEST(Tool, every_shape_is_within_the_servers_limits) {
  const MaterialMasses nothing;
  for (const float voxel_m : {0.25F, limits::voxel_size_min_m})
    for (const ToolKind kind : all_kinds<ToolKind>)
      for (const float radius_m : {tool_radius_min_m, 2.0F, tool_radius_max_m}) {
        Tool tool;
        tool.use = ToolUse::carve;
        tool.kind = kind;
        tool.radius_m = radius_m;
        const glm::vec3 direction = glm::normalize(glm::vec3(1, -2, 3));
        const auto carve = std::get<CarveRequest>(
            request_of(tool, {1.0F, 2.0F, 3.0F}, direction, 7, {builtin_palette(), nothing, voxel_m}));
        EXPECT_TRUE(validate_edit(carve.shape, voxel_m)) << name_of(kind) << " " << radius_m;
        EXPECT_LT(distance(carve.shape, carve.impact_m), 0.0F) << "the surface is opened";
        EXPECT_LE(carve.seeds, limits::seeds_max);
      }
}

TEST(Tool, what_is_filled_stands_on_the_rock_and_what_is_painted_is_in_it) {
  const glm::vec3 hit_m(1.0F, 2.0F, 3.0F), down(0.0F, -1.0F, 0.0F);
  const MaterialMasses carried{{material::soil, 500}};
  const ToolHolder holder{builtin_palette(), carried, 0.25F};
  Tool tool;
  const auto dig = std::get<DigRequest>(request_of(tool, hit_m, down, 1, holder));
  EXPECT_EQ(dig.store, StoreName{});
  EXPECT_LT(centre_of(dig.shape).y, hit_m.y);
  change(tool, Action::next_use);
  const auto place = std::get<PlaceRequest>(request_of(tool, hit_m, down, 1, holder));
  EXPECT_EQ(place.material, material::soil) << "there is no other in the store";
  EXPECT_FALSE(place.solid);
  EXPECT_GT(centre_of(place.shape).y, hit_m.y);
  EXPECT_TRUE(
      std::get<PlaceRequest>(request_of(tool, hit_m, down, 1, {builtin_palette(), carried, 0.25F, true}))
          .solid);
  change(tool, Action::fill);
  const auto fill = std::get<FillRequest>(request_of(tool, hit_m, down, 1, holder));
  EXPECT_LT(distance(fill.shape, hit_m), 0.0F) << "it touches";
  EXPECT_GT(centre_of(fill.shape).y, hit_m.y) << "and is mostly outside";
  change(tool, Action::next_use);
  change(tool, Action::next_material, builtin_palette());
  const auto paint = std::get<PaintRequest>(request_of(tool, hit_m, down, 1, holder));
  EXPECT_EQ(paint.material, material::soil);
  EXPECT_LT(distance(paint.shape, hit_m), 0.0F);
  change(tool, Action::next_use);
  EXPECT_EQ(tool.use, ToolUse::dig);
}

TEST(Tool, places_what_one_carries_most_of_and_goes_round_among_that) {
  const MaterialMasses carried{{material::rock, 100}, {material::soil, 900}, {material::ice, 300}};
  const Palette& palette = builtin_palette();
  Tool tool;
  change(tool, Action::place);
  EXPECT_EQ(placed_by(tool, {}, palette), std::nullopt);
  EXPECT_EQ(placed_by(tool, carried, palette), material::soil);
  for (const Material next : {material::ice, material::rock, material::soil}) {
    change(tool, Action::next_material, palette, carried);
    EXPECT_EQ(placed_by(tool, carried, palette), next);
  }
  tool.material = "brick";
  EXPECT_EQ(placed_by(tool, carried, palette), material::soil) << "one does not carry any";
}

TEST(Tool, a_size_that_nobody_chose_is_the_usual_one_of_the_use) {
  Tool tool;
  change(tool, Action::carve);
  EXPECT_EQ(tool.radius_m, 2.0F);
  change(tool, Action::dig);
  EXPECT_EQ(tool.radius_m, 1.5F);
  change(tool, Action::larger);
  const float chosen_m = tool.radius_m;
  change(tool, Action::carve);
  EXPECT_EQ(tool.radius_m, chosen_m);
}

TEST(Repeat, acts_once_a_press_and_again_while_it_is_held) {
  Repeat button;
  EXPECT_EQ(button.step(0, true, 0.25, 10.0), 0) << "held, but pressed for something else";
  EXPECT_EQ(button.step(0, false, 0.25, 10.1), 0);
  EXPECT_EQ(button.step(1, true, 0.25, 11.0), 1);
  EXPECT_EQ(button.step(0, true, 0.25, 11.2), 0);
  EXPECT_EQ(button.step(0, true, 0.25, 11.4), 0) << "a short press looks so long on a slow machine";
  EXPECT_EQ(button.step(0, true, 0.25, 11.5), 1);
  EXPECT_EQ(button.step(0, true, 0.25, 11.7), 0);
  EXPECT_EQ(button.step(0, true, 0.25, 11.8), 1);
  EXPECT_EQ(button.step(0, false, 0.25, 12.0), 0);
  EXPECT_EQ(button.step(0, true, 0.25, 12.5), 0);
  EXPECT_EQ(button.step(3, false, 0.25, 12.8), 3) << "all presses of a slow frame";
  EXPECT_EQ(button.step(1, true, 0.7, 14.0), 1);
  EXPECT_EQ(button.step(0, true, 0.7, 14.6), 0) << "a tool that is slower than that";
}

TEST(RefusalWords, leave_the_names_of_settings_to_operators) {
  EXPECT_EQ(without_options("the limit is 8 m (reach): go nearer"), "the limit is 8 m: go nearer");
  EXPECT_EQ(without_options("50 m³ a second here (dig-m3-per-s), and more (limits.pieces_max)"),
            "50 m³ a second here, and more");
  EXPECT_EQ(without_options("at (1, 2, 3) m (two words)"), "at (1, 2, 3) m (two words)");
  EXPECT_EQ(without_options("an open ("), "an open (");
  EXPECT_EQ(in_brief("reach"), "too far away");
  EXPECT_EQ(in_brief("game:full_moon"), "not allowed here");
  EXPECT_EQ(in_brief("unheard_of"), "not possible here");
}

TEST(Hints, go_on_when_they_are_followed_or_had_their_time) {
  Hints hints;
  EXPECT_EQ(hints.text(true, true, 0.0), "") << "before the first strike, a program tells of its hands";
  hints.note(ToolUse::dig);
  EXPECT_NE(hints.text(false, true, 1.0).find("topples"), std::string_view::npos);
  for (int i = 0; i < 4; ++i) hints.note(ToolUse::carve);
  EXPECT_NE(hints.text(false, true, 2.0).find("rewind"), std::string_view::npos);
  EXPECT_NE(hints.text(false, true, 41.0).find("rewind"), std::string_view::npos);
  EXPECT_EQ(hints.text(false, true, 43.0), "") << "nothing is carried";
  EXPECT_NE(hints.text(true, true, 44.0).find("place"), std::string_view::npos);
  hints.note(ToolUse::place);
  EXPECT_EQ(hints.text(true, true, 45.0), "");
}

TEST(Tool, materials_are_known_by_name_and_one_that_the_world_lacks_is_its_first) {
  const Palette& palette = builtin_palette();
  Tool tool;
  tool.use = ToolUse::fill;
  EXPECT_EQ(material_of(tool, palette), std::nullopt) << "as the ground";
  for (const MaterialRow& row : palette.rows) {
    change(tool, Action::next_material, palette);
    EXPECT_EQ(tool.material, row.name);
    EXPECT_EQ(std::get<FillRequest>(
                  request_of(tool, {}, {0.0F, -1.0F, 0.0F}, 1, {palette, MaterialMasses{}, 0.25F}))
                  .material,
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
  tool.kind = ToolKind::box;
  change(tool, Action::next_tool);
  EXPECT_EQ(tool.kind, ToolKind::tunnel);
  change(tool, Action::next_tool);
  EXPECT_EQ(tool.kind, ToolKind::crater);
  change(tool, Action::next_tool);
  EXPECT_EQ(tool.kind, ToolKind::sphere);
}

TEST(Tool, is_told_with_what_it_does_and_units) {
  Tool tool;
  EXPECT_EQ(describe(tool), "dig: crater, radius 1.50 m");
  change(tool, Action::carve);
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

}  // namespace
}  // namespace scree
