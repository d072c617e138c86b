// The tables of a palette's members: every bound of every number holds, alone and in a whole palette.
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>

#include "shared/material/material_members.h"
#include "tests/content/small_palette.h"

namespace scree {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

float below(float number) {
  return std::nextafter(number, -std::numeric_limits<float>::infinity());
}
float above(float number) {
  return std::nextafter(number, std::numeric_limits<float>::infinity());
}

std::string refusal(const Palette& palette) {
  const auto valid = validate(palette);
  return valid ? "" : valid.error().message;
}

std::string refusal_of_change(const Palette& before, const Palette& next) {
  const auto valid = validate_change(before, next);
  return valid ? "" : valid.error().message;
}

TEST(PaletteMembers, every_member_has_a_name_bounds_and_words) {
  std::set<std::string_view> names;
  for (const MaterialNumber& member : material_numbers()) {
    EXPECT_TRUE(names.insert(member.name).second) << member.name;
    EXPECT_LT(member.least, member.most) << member.name;
    EXPECT_FALSE(member.help.empty()) << member.name;
  }
  for (const MaterialChoice& member : material_choices()) {
    EXPECT_TRUE(names.insert(member.name).second) << member.name;
    EXPECT_GE(member.values.size(), 2U) << member.name;
  }
  EXPECT_EQ(number_names().size() + choice_names().size(), names.size());
}

TEST(PaletteMembers, each_number_is_a_member_of_its_own) {
  for (const MaterialNumber& member : material_numbers()) {
    MaterialRow row;
    const float next = member.get(row) == member.most ? member.least : member.most;
    ASSERT_TRUE(set_number(row, member.name, next)) << member.name;
    for (const MaterialNumber& other : material_numbers())
      EXPECT_EQ(number_of(row, other.name), other.name == member.name ? next : other.get(MaterialRow{}))
          << member.name << " " << other.name;
    EXPECT_FALSE(row == MaterialRow{}) << member.name;
  }
}

TEST(PaletteMembers, a_number_keeps_its_bounds) {
  for (const MaterialNumber& member : material_numbers()) {
    const std::string name(member.name);
    MaterialRow row;
    EXPECT_TRUE(set_number(row, name, member.least)) << name;
    EXPECT_TRUE(set_number(row, name, member.most)) << name;
    const MaterialRow before = row;
    for (const double value : {static_cast<double>(below(member.least)), -1.0e300, -infinite,
                               static_cast<double>(above(member.most)), 1.0e300, infinite, std::nan("")}) {
      const auto set = set_number(row, name, value);
      ASSERT_FALSE(set) << name << " " << value;
      EXPECT_TRUE(set.error().message.starts_with(name + " ")) << set.error().message;
      EXPECT_TRUE(row == before) << name;
    }
  }
}

TEST(PaletteMembers, a_palette_with_a_number_beyond_its_bounds_is_refused_by_row_and_member) {
  for (const MaterialNumber& member : material_numbers())
    for (const float value : {below(member.least), above(member.most), std::nanf(""), -INFINITY, INFINITY}) {
      Palette palette = small_palette();
      member.put(palette.rows[1], value);
      EXPECT_TRUE(refusal(palette).starts_with("sand: " + std::string(member.name) + " "))
          << refusal(palette);
    }
  for (const GroundNumber& member : ground_numbers())
    for (const float value : {below(member.least), above(member.most), std::nanf(""), -INFINITY, INFINITY}) {
      Palette palette = small_palette();
      member.put(palette.ground, value);
      EXPECT_TRUE(refusal(palette).starts_with("ground: " + std::string(member.name) + " "))
          << refusal(palette);
    }
}

TEST(PaletteMembers, a_refusal_names_value_bound_and_unit) {
  MaterialRow row;
  EXPECT_EQ(set_number(row, "density", 30000.0).error().message, "density 30000 is over 25000 kg/m3");
  EXPECT_EQ(set_number(row, "density", 5.5).error().message, "density 5.5 is below 10 kg/m3");
  EXPECT_EQ(set_number(row, "restitution", 0.96).error().message, "restitution 0.96 is over 0.95");
  EXPECT_EQ(set_number(row, "density", above(25000.0F)).error().message,
            "density 25000.002 is over 25000 kg/m3");
  EXPECT_EQ(set_number(row, "sound.pitch", infinite).error().message, "sound.pitch must be a finite number");
}

TEST(PaletteMembers, an_unknown_member_is_refused_with_the_near_name) {
  MaterialRow row;
  EXPECT_EQ(set_number(row, "strenght", 1.0).error().message,
            "there is no number 'strenght'; did you mean strength?");
  EXPECT_EQ(set_choice(row, "brakes", "even").error().message,
            "there is no choice 'brakes'; did you mean breaks?");
  EXPECT_FALSE(number_of(row, "strenght"));
  EXPECT_FALSE(choice_of(row, "density"));
}

TEST(PaletteMembers, a_choice_is_set_by_the_name_of_its_value) {
  for (const MaterialChoice& member : material_choices()) {
    MaterialRow row;
    for (const std::string_view value : member.values) {
      EXPECT_TRUE(set_choice(row, member.name, value));
      EXPECT_EQ(choice_of(row, member.name), value);
    }
    Palette palette = small_palette();
    member.put(palette.rows[0], static_cast<uint8_t>(member.values.size()));
    EXPECT_TRUE(refusal(palette).starts_with("rock: " + std::string(member.name) + " is not a known one"));
  }
  MaterialRow row;
  EXPECT_EQ(set_choice(row, "breaks", "shard").error().message,
            "breaks 'shard' is not even, grain, slabs or shards");
}

TEST(PaletteMembers, names_are_short_plain_and_different) {
  for (const char* name : {"a", "rock", "rock_2", "abcdefghijklmnopqrstuvwxyz_01234"}) {
    Palette palette = small_palette();
    palette.rows[1].name = name;
    EXPECT_EQ(refusal(palette), name == std::string("rock") ? "rock: two materials have this name" : "");
  }
  for (const char* name :
       {"", "Rock", "2rock", "_rock", "red rock", "rock\n", "röck", "abcdefghijklmnopqrstuvwxyz_012345"}) {
    Palette palette = small_palette();
    palette.rows[1].name = name;
    EXPECT_TRUE(refusal(palette).starts_with("material 1: it")) << name << refusal(palette);
  }
}

TEST(PaletteMembers, a_palette_has_1_to_255_rows) {
  Palette palette;
  EXPECT_EQ(refusal(palette), "a palette has at least one material");
  palette = palette_of(materials_max);
  EXPECT_EQ(refusal(palette), "");
  palette = palette_of(materials_max + 1);
  EXPECT_EQ(refusal(palette), "256 materials are over the limit of 255");
}

TEST(PaletteMembers, the_rows_of_the_ground_exist) {
  for (Material GroundRows::*layer : {&GroundRows::bulk, &GroundRows::soil, &GroundRows::cap}) {
    Palette palette = small_palette();
    palette.ground.*layer = Material{2};
    EXPECT_TRUE(refusal(palette).ends_with("is material 2, and the palette has 2")) << refusal(palette);
  }
}

TEST(PaletteMembers, a_change_may_alter_numbers_and_add_rows) {
  const Palette before = small_palette();
  Palette next = before;
  next.rows[1].density_kg_m3 = 1500.0F;
  next.rows.push_back(next.rows[1]);
  next.rows.back().name = "gravel";
  EXPECT_EQ(refusal_of_change(before, next), "");
}

TEST(PaletteMembers, a_change_may_not_remove_rename_or_reorder_rows_or_alter_the_ground) {
  const Palette before = small_palette();
  Palette next = before;
  next.rows.pop_back();
  next.ground.cap = next.ground.soil = next.ground.bulk;
  EXPECT_EQ(
      refusal_of_change(before, next),
      "material 1 is sand so far, and the new palette has none: materials may be added, but not removed");
  next = before;
  std::swap(next.rows[0], next.rows[1]);
  EXPECT_TRUE(
      refusal_of_change(before, next).starts_with("material 0 is rock so far, and sand in the new palette"));
  next = before;
  next.rows[1].name = "gravel";
  EXPECT_TRUE(refusal_of_change(before, next).starts_with("material 1 is sand so far, and gravel"));
  next = before;
  next.ground.cap_depth_m = 2.0F;
  EXPECT_TRUE(refusal_of_change(before, next).starts_with("the new palette has another [ground]"));
  next = before;
  next.rows[0].friction = 3.0F;
  EXPECT_EQ(refusal_of_change(before, next), "rock: friction 3 is over 2");
}

}  // namespace
}  // namespace scree
