// The built-in palette: its file has no mistakes, and its first materials have the numbers that worlds of
// before palettes were made with.
#include "content/builtin_palette.h"

#include <array>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>

#include "content/files/palette_file.h"
#include "content/palette_text.h"
#include "shared/material/material_members.h"

namespace scree {
namespace {

TEST(BuiltinPalette, is_the_file_of_the_sources) {
  std::ifstream in(std::string(SCREE_SOURCE_DIR) + "/content/materials.toml");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(builtin_palette_text(), text);
  const Result<Palette> read = read_palette(text, "materials.toml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(*read == builtin_palette());
  EXPECT_TRUE(validate(*read));
}

TEST(BuiltinPalette, has_these_materials_in_this_order) {
  const std::vector<std::string_view> wanted{
      "rock",         "soil",          "ice",          "sand",        "clay",
      "gravel",       "concrete",      "brick",        "timber",      "glass",
      "steel",        "snow",          "rock_rubble",  "ice_rubble",  "concrete_rubble",
      "brick_rubble", "timber_rubble", "glass_rubble", "steel_rubble"};
  EXPECT_EQ(builtin_palette().names(), wanted);
}

/// Each row says all numbers: a reader of the file need not know the defaults.
TEST(BuiltinPalette, says_every_physical_number_of_every_material) {
  const std::string text(builtin_palette_text());
  const auto rows = static_cast<size_t>(
      std::ranges::count_if(builtin_palette().rows, [](const MaterialRow& row) { return !row.rubble; }));
  for (const std::string& name : number_names()) {
    if (name.starts_with("look.pattern_m") || name.starts_with("look.image_m"))
      continue;  // where there is one
    const std::string last = name.substr(name.rfind('.') + 1) + " = ";
    size_t count = 0;
    for (size_t at = text.find(last); at != std::string::npos; at = text.find(last, at + 1))
      if (at == 0 || text[at - 1] == '\n' || text[at - 1] == ' ') ++count;
    EXPECT_EQ(count, rows) << name;
  }
}

std::string text_of_page() {
  std::ifstream in(std::string(SCREE_SOURCE_DIR) + "/docs/materials.md");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The page's row of a member has its bounds, its unit, and its value in a row that leaves it out.
void expect_on_page(const std::string& page, std::string_view name, std::array<float, 3> numbers,
                    std::string_view unit) {
  const size_t begin = page.find("| `" + std::string(name) + "` | ");
  ASSERT_NE(begin, std::string::npos) << name;
  const std::string line = page.substr(begin, page.find('\n', begin) - begin);
  static const std::regex row(R"(\| `[a-z_.]+` \| (\S+) to (\S+)( \S+)? \| (\S+) \| .+ \|)");
  std::smatch match;
  ASSERT_TRUE(std::regex_match(line, match, row)) << line;
  EXPECT_EQ(std::stof(match[1]), numbers[0]) << line;
  EXPECT_EQ(std::stof(match[2]), numbers[1]) << line;
  EXPECT_EQ(std::stof(match[4]), numbers[2]) << line;
  EXPECT_EQ(match[3], unit.empty() ? "" : " " + std::string(unit)) << line;
}

TEST(MaterialsPage, has_every_member_with_its_bounds) {
  const std::string page = text_of_page();
  for (const MaterialNumber& member : material_numbers())
    expect_on_page(page, member.name, {member.least, member.most, member.get({})}, member.unit);
  for (const GroundNumber& member : ground_numbers())
    expect_on_page(page, member.name, {member.least, member.most, member.get({})}, member.unit);
  for (const MaterialChoice& member : material_choices()) {
    std::string values;
    for (const std::string_view value : member.values)
      values += (values.empty() ? "`" : ", `") + std::string(value) + "`";
    const std::string usual(member.values[member.get({})]);
    EXPECT_NE(page.find("| `" + std::string(member.name) + "` | " + values + " | `" + usual + "` | "),
              std::string::npos)
        << member.name;
  }
}

TEST(MaterialsPage, shows_a_palette_that_can_be_read) {
  const std::string page = text_of_page(), fence = "```toml\n";
  const size_t begin = page.find(fence) + fence.size();
  const Result<Palette> read = read_palette(page.substr(begin, page.find("```", begin) - begin), "page");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->names(), (std::vector<std::string_view>{"rock", "turf", "rock_rubble", "turf_rubble"}));
}

TEST(MaterialsPage, shows_rubble_of_ones_own_that_can_be_read) {
  const std::string page = text_of_page(), fence = "```toml\n";
  const size_t begin = page.find(fence, page.find("## Rubble")) + fence.size();
  const std::string ground = "[ground]\nbulk = \"rock\"\nsoil = \"rock\"\ncap = \"rock\"\n";
  const Result<Palette> whole =
      read_palette(ground + page.substr(begin, page.find("```", begin) - begin), "page");
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->names(), (std::vector<std::string_view>{"rock", "scree"}));
  EXPECT_EQ(whole->rows[1].rubble, (RubbleOf{.of = Material{0}, .fill = 77}));
}

struct FormerRow {
  const char* name;
  float density_kg_m3, friction, strength_m_s, seed_density, dent_resistance_j_m3;
  Bearing bearing;
  std::array<float, 3> albedo;
};
constexpr std::array former_rows{
    FormerRow{"rock",
              2600.0F,
              0.7F,
              10.0F,
              1.0F,
              5.0e7F,
              {5.1e6F, 1.27e6F, 6.4e5F, 2.75e6F},
              {0.33F, 0.31F, 0.30F}},
    FormerRow{
        "soil", 1700.0F, 0.9F, 7.0F, 1.5F, 2.5e5F, {4.0e5F, 1.0e5F, 5.0e4F, 1.0e5F}, {0.20F, 0.12F, 0.06F}},
    FormerRow{
        "ice", 920.0F, 0.3F, 6.0F, 1.25F, 5.0e6F, {1.35e6F, 3.4e5F, 1.7e5F, 7.3e5F}, {0.62F, 0.76F, 0.86F}}};

TEST(BuiltinPalette, rock_soil_and_ice_have_their_former_numbers) {
  for (size_t i = 0; i < former_rows.size(); ++i) {
    const FormerRow& former = former_rows[i];
    const MaterialRow& row = builtin_palette().rows[i];
    EXPECT_EQ(row.name, former.name);
    EXPECT_EQ(row.density_kg_m3, former.density_kg_m3) << former.name;
    EXPECT_EQ(row.friction, former.friction) << former.name;
    EXPECT_EQ(row.restitution, 0.05F) << former.name;
    EXPECT_EQ(row.strength_m_s, former.strength_m_s) << former.name;
    EXPECT_EQ(row.strength_by_size, 0.25F) << former.name;
    EXPECT_EQ(row.seed_density, former.seed_density) << former.name;
    EXPECT_EQ(row.dent_resistance_j_m3, former.dent_resistance_j_m3) << former.name;
    EXPECT_TRUE(row.bearing == former.bearing) << former.name;
    EXPECT_EQ(row.look.colour, former.albedo) << former.name;
  }
  EXPECT_TRUE(builtin_palette().ground == GroundRows{});
}

TEST(BuiltinPalette, rock_soil_and_ice_ring_as_before) {
  constexpr float rock_hz = 190.0F;
  constexpr std::array pitches_hz{190.0F, 70.0F, 420.0F}, damping_s{0.05F, 0.03F, 0.12F},
      noise{0.6F, 0.85F, 0.4F};
  for (size_t i = 0; i < pitches_hz.size(); ++i) {
    const MaterialSound& sound = builtin_palette().rows[i].sound;
    EXPECT_FLOAT_EQ(sound.pitch * rock_hz, pitches_hz[i]);
    EXPECT_EQ(sound.damping_s, damping_s[i]);
    EXPECT_EQ(sound.noise, noise[i]);
  }
}

/// Recordings of format 6 and worlds of format 1 name no palette, and are read with the built-in one. Their
/// rules know no rubble. When another number of it is to change, keep the palette as it is now as a file of
/// its own, which config_of() (server/world/recorded_values.cpp) then takes where a header has none.
TEST(BuiltinPalette, is_but_for_rubble_the_one_with_which_old_files_are_read) {
  Palette former = builtin_palette();
  std::erase_if(former.rows, [](const MaterialRow& row) { return row.rubble.has_value(); });
  for (MaterialRow& row : former.rows) row.loose = false;
  EXPECT_EQ(hex_of(palette_digest(former)),
            "a4e288175ad57562bd3e987b587db49f2fbdfa1f9ac066218f3928a97380a377");
}

TEST(BuiltinPalette, materials_come_apart_in_different_ways) {
  const Palette& palette = builtin_palette();
  const auto breaks = [&](const char* name) { return palette.row(*palette.named(name)).breaks; };
  EXPECT_EQ(breaks("glass"), BreakLook::shards);
  EXPECT_EQ(breaks("ice"), BreakLook::shards);
  EXPECT_EQ(breaks("timber"), BreakLook::grain);
  EXPECT_EQ(breaks("brick"), BreakLook::even);
  EXPECT_EQ(palette.row(*palette.named("timber")).axis, GrainAxis::x);
}

}  // namespace
}  // namespace scree
