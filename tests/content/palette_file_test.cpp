// Palettes as files: what people may write, and what each mistake is answered.
#include "content/files/palette_file.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sys/stat.h>

#include "content/builtin_palette.h"
#include "content/limits.h"
#include "content/palette_text.h"
#include "shared/material/material_members.h"
#include "tests/content/small_palette.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

const std::string ground = "[ground]\nbulk = \"rock\"\nsoil = \"rock\"\ncap = \"rock\"\n";  // 4 lines
const std::string rock = "[[material]]\nname = \"rock\"\n";                                 // 5 and 6

std::string refusal(const std::string& text) {
  const Result<Palette> read = read_palette(text, "m.toml");
  return read ? "" : read.error().message;
}

/// The answer to a line in rock's table, without its place.
std::string refusal_in_rock(const std::string& line) {
  const std::string said = refusal(ground + rock + line), place = "m.toml:7: rock: ";
  EXPECT_TRUE(said.empty() || said.starts_with(place)) << said;
  return said.empty() ? said : said.substr(place.size());
}

TEST(PaletteFile, a_row_with_a_name_alone_has_the_usual_numbers) {
  const Result<Palette> read = read_palette(ground + rock, "m.toml");
  ASSERT_TRUE(read) << read.error().message;
  MaterialRow usual;
  usual.name = "rock";
  EXPECT_EQ(read->names(), (std::vector<std::string_view>{"rock", "rock_rubble"}));
  EXPECT_TRUE(read->rows.front() == usual);
  EXPECT_TRUE(read->ground == (GroundRows{Material{0}, Material{0}, Material{0}, 1.0F, 1.5F}));
}

TEST(PaletteFile, every_number_is_read_by_its_name) {
  for (const MaterialNumber& member : material_numbers()) {
    const std::string name(member.name);
    const Result<Palette> read =
        read_palette(ground + rock + name + " = " + std::to_string(member.most), "m.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(member.get(read->rows.front()), member.most) << name;
  }
}

TEST(PaletteFile, every_number_keeps_its_bounds) {
  for (const MaterialNumber& member : material_numbers()) {
    const std::string name(member.name);
    for (const char* value : {"-1e30", "1e30", "1e300", "-inf", "inf", "nan"}) {
      const std::string said = refusal_in_rock(name + " = " + value);
      EXPECT_TRUE(said.starts_with(name + " ")) << name << " = " << value << ": " << said;
    }
    EXPECT_EQ(refusal_in_rock(name + " = true"), name + " must be a number, and is true or false");
    EXPECT_EQ(refusal_in_rock(name + " = \"1\""), name + " must be a number, and is a text");
    EXPECT_EQ(refusal_in_rock(name + " = [1]"), name + " must be a number, and is a list");
    EXPECT_EQ(refusal_in_rock(name + ".x = 1"), name + " must be a number, and is a table");
  }
}

TEST(PaletteFile, every_choice_is_read_by_name) {
  for (const MaterialChoice& member : material_choices()) {
    const std::string name(member.name);
    for (size_t i = 0; i < member.values.size(); ++i) {
      const std::string line = name + " = \"" + std::string(member.values[i]) + "\"";
      const Result<Palette> read = read_palette(ground + rock + line, "m.toml");
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_EQ(member.get(read->rows.front()), i) << name;
    }
    EXPECT_TRUE(refusal_in_rock(name + " = \"odd\"").starts_with(name + " 'odd' is not ")) << name;
    EXPECT_EQ(refusal_in_rock(name + " = 1"), name + " must be a text, and is a number");
  }
}

TEST(PaletteFile, tables_and_dotted_names_are_the_same) {
  for (const char* text :
       {"bearing.pressed = 7", "bearing = { pressed = 7 }", "[material.bearing]\npressed = 7"}) {
    const Result<Palette> read = read_palette(ground + rock + text, "m.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->rows.front().bearing.pressed_pa, 7.0F);
  }
  EXPECT_EQ(refusal_in_rock("bearing = 7"), "bearing must be a table, and is a number");
}

TEST(PaletteFile, an_error_names_file_line_and_row) {
  EXPECT_EQ(refusal(ground + rock + "[[material]]\nname = \"brick\"\n# much\ndensity = 30000\n"),
            "m.toml:10: brick: density 30000 is over 25000 kg/m3");
  EXPECT_EQ(refusal(ground + rock + "[material.sound]\npitch = 30\n"),
            "m.toml:8: rock: sound.pitch 30 is over 20");
}

TEST(PaletteFile, an_unknown_name_is_refused_with_the_near_one) {
  EXPECT_EQ(refusal_in_rock("densty = 1"), "there is no 'densty'; did you mean density?");
  EXPECT_EQ(refusal_in_rock("bearing.presed = 1"),
            "there is no 'bearing.presed'; did you mean bearing.pressed?");
  EXPECT_EQ(refusal_in_rock("looks.roughness = 1"), "there is no 'looks'; did you mean look?");
  EXPECT_EQ(refusal_in_rock("albedo = \"x.png\""), "there is no 'albedo'");
  EXPECT_EQ(refusal("grounds = 1\n" + ground + rock),
            "m.toml:1: there is no 'grounds'; did you mean ground?");
  EXPECT_EQ(refusal(ground + "soil_depth = 1\n" + rock),
            "m.toml:5: ground: there is no 'soil_depth'; did you mean soil_depth_m?");
  EXPECT_EQ(refusal_in_rock("\"a\\nb\" = 1"), "there is no 'a b'");
}

TEST(PaletteFile, an_empty_file_is_refused) {
  const std::string said = "m.toml: it has no material: a palette has 1 to 255, each a table [[material]]";
  EXPECT_EQ(refusal(""), said);
  EXPECT_EQ(refusal("# nothing\n"), said);
  EXPECT_EQ(refusal(ground), said);
  EXPECT_EQ(refusal(ground + "[material]\nname = \"rock\"\n"),
            "m.toml:5: each material is a table [[material]]");
  EXPECT_EQ(refusal("material = 1\n"), "m.toml:1: each material is a table [[material]]");
  EXPECT_EQ(refusal("material = [1, {name = \"a\"}]\n"), "m.toml:1: each material is a table [[material]]");
  EXPECT_EQ(refusal("material = []\n"), "m.toml:1: each material is a table [[material]]");
}

TEST(PaletteFile, a_file_without_its_grounds_rows_is_refused) {
  EXPECT_EQ(refusal(rock),
            "m.toml: it has no table [ground], which names the materials of bulk, soil and cap");
  EXPECT_EQ(refusal("ground = 1\n" + rock), "m.toml:1: ground must be a table, and is a number");
  EXPECT_EQ(refusal("[ground]\nbulk = \"rock\"\ncap = \"rock\"\n" + rock),
            "m.toml:1: ground: it does not say the material of soil");
  EXPECT_EQ(refusal("[ground]\nbulk = \"rok\"\nsoil = \"rock\"\ncap = \"rock\"\n" + rock),
            "m.toml:2: ground: bulk 'rok' is no material; did you mean rock?");
  EXPECT_EQ(refusal("[ground]\nbulk = 0\nsoil = \"rock\"\ncap = \"rock\"\n" + rock),
            "m.toml:2: ground: bulk must be a text, and is a number");
}

TEST(PaletteFile, the_depths_of_the_ground_keep_their_bounds) {
  for (const GroundNumber& member : ground_numbers()) {
    const std::string name(member.name);
    for (const char* value : {"-0.1", "50.1", "inf", "nan"}) {
      const std::string said = refusal(ground + name + " = " + value + "\n" + rock);
      EXPECT_TRUE(said.starts_with("m.toml:5: ground: " + name + " ")) << said;
    }
    const Result<Palette> read = read_palette(ground + name + " = 50\n" + rock, "m.toml");
    ASSERT_TRUE(read);
    EXPECT_EQ(member.get(read->ground), 50.0F);
  }
}

TEST(PaletteFile, names_are_there_plain_and_different) {
  EXPECT_EQ(refusal(ground + rock + "[[material]]\ndensity = 100\n"), "m.toml:7: material 1: it has no name");
  EXPECT_EQ(refusal(ground + rock + "[[material]]\nname = 1\n"),
            "m.toml:8: material 1: name must be a text, and is a number");
  EXPECT_EQ(refusal(ground + rock + "[[material]]\nname = \"Sand\"\n"),
            "m.toml:8: material 1: its name must begin with a letter, and have only a to z, 0 to 9 and _");
  EXPECT_EQ(refusal(ground + rock + "[[material]]\nname = \"rock\"\n"),
            "m.toml:7: rock: another material, in line 5, has this name");
  EXPECT_TRUE(refusal(ground + "[[material]]\nname = \"" + std::string(33, 'a') + "\"\n")
                  .starts_with("m.toml:6: material 0: its name has 33 characters"));
}

TEST(PaletteFile, there_are_255_materials_at_most) {
  std::string text = ground + rock;
  for (size_t i = 1; i < materials_max; ++i) text += "[[material]]\nname = \"m" + std::to_string(i) + "\"\n";
  EXPECT_EQ(refusal(text), "");
  EXPECT_EQ(refusal(text + "[[material]]\nname = \"last\"\n"),
            "m.toml:515: 256 materials are over the limit of 255");
}

TEST(PaletteFile, what_is_no_toml_is_refused_with_its_line) {
  for (const char* text :
       {"[ground]\nbulk = rock\n", "a = 1\na = 2\n", "[ground]\nbulk = \"\xff\"\n", "\n= 1\n", "x\n{"})
    EXPECT_TRUE(refusal(text).starts_with("m.toml:2: ") || refusal(text).starts_with("m.toml:1: "))
        << refusal(text);
}

TEST(PaletteFile, text_on_which_the_parser_breaks_its_own_rules_is_refused_with_its_line) {
  for (const char* text : {"[[[material]]]", "[&", "[[=", "[(", "[[[1]]]\n"}) {
    EXPECT_EQ(refusal(text), "m.toml:1: it is no TOML") << text;
    EXPECT_EQ(refusal(ground + rock + text), "m.toml:7: it is no TOML") << text;
    EXPECT_EQ(refusal(ground + rock + text + "\n\n# more\n[x]\n"), "m.toml:7: it is no TOML") << text;
  }
}

TEST(PaletteFile, materials_may_be_a_list_of_inline_tables) {
  const std::string list = "material = [ { name = \"rock\" },\n  { name = \"clay\", density = 1800 } ]\n";
  const Result<Palette> read = read_palette(list + ground, "m.toml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->names(), (std::vector<std::string_view>{"rock", "clay", "rock_rubble", "clay_rubble"}));
  EXPECT_EQ(read->rows[1].density_kg_m3, 1800.0F);
  EXPECT_EQ(refusal("material = [ { name = \"rock\" },\n  { name = \"rock\" } ]\n" + ground),
            "m.toml:2: rock: another material, in line 1, has this name");
  EXPECT_EQ(refusal(ground + list),
            "m.toml:5: this 'material' stands under [ground] and belongs to it: put it before [ground]");
}

TEST(PaletteFile, comments_alone_have_other_characters_than_ascii) {
  EXPECT_EQ(refusal("\xEF\xBB\xBF" + ground + rock + "# \xC3\xA9 \xE2\x80\xA8\n"), "");
  for (const char* bytes : {"\xFF\xFE", "\xC3", "\xED\xA0\x80"})
    EXPECT_EQ(refusal(ground + rock + "# " + bytes + "\n"),
              "m.toml:7: the comment is not UTF-8: save the file in that encoding");
  EXPECT_EQ(refusal(ground + rock + "breaks = \"even\" # \xC3\xA9\n"), "");
  EXPECT_EQ(refusal(ground + rock + "breaks = 'ev#en' # \xC3\xA9\n"),
            "m.toml:7: rock: breaks 'ev#en' is not even, grain, slabs or shards");
  const std::string said = "m.toml:7: only comments have other characters than those of ASCII";
  for (const char* line : {"\xC3\xA9 = 1", "a = \xEF\xBB\xBE", "breaks = \"\xC3\xA9\"", "a = '#' \xC3\xA9",
                           "a = \"\\\"#\" \xC3\xA9", "a = '\\' \xC3\xA9 # '"})
    EXPECT_EQ(refusal(ground + rock + line), said) << line;
  for (const char* line : {"a = \"\"\"", "a = '''x'''", "a = \"\"\"\n# \"\"\" \xC3\xA9"})
    EXPECT_EQ(refusal(ground + rock + line),
              "m.toml:7: a text stands in one line, between one quote and another");
}

TEST(PaletteFile, long_lines_long_files_and_deep_files_are_refused) {
  EXPECT_EQ(refusal("a = 1\n#" + std::string(limits::palette_line_bytes_max, ' ') + "\n"),
            "m.toml:2: the line has 501 bytes, over the limit of 500");
  std::string dots = "a";
  while (dots.size() < 200'000) dots += ".a";
  EXPECT_TRUE(refusal(dots + " = 1\n").starts_with("m.toml:1: the line has "));
  std::string deep;
  for (int i = 0; i < 20'000; ++i) deep += "[\n";
  EXPECT_TRUE(refusal("a = " + deep).starts_with("m.toml:")) << refusal("a = " + deep);
  EXPECT_TRUE(
      refusal(std::string(limits::palette_file_bytes_max + 1, '\n')).starts_with("m.toml: it has 257 KiB"));
  EXPECT_NE(refusal(std::string(limits::palette_file_bytes_max, '\n')), "");
}

/// The deepest text within the limits: its parts must neither overflow the stack nor take long.
TEST(PaletteFile, the_deepest_lists_of_dotted_tables_are_refused_too) {
  std::string dots = "a", text;
  while (dots.size() < limits::palette_line_bytes_max - 20) dots += ".a";
  for (int i = 0; i < 100; ++i) text += (i == 0 ? dots : "{" + dots) + " = [\n";
  EXPECT_NE(refusal(text), "");
  std::string tables;
  for (int i = 0; i < 400; ++i) tables += "[" + dots + ".b" + std::to_string(i) + "]\n";
  EXPECT_NE(refusal(tables), "");
}

TEST(PaletteFile, no_changed_text_ends_the_program) {
  const std::string text(builtin_palette_text());
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::string changed = text;
    for (uint32_t i = 0; i <= random() % 4; ++i) {
      const size_t at = random() % changed.size();
      if (random() % 2 == 0)
        changed[at] = static_cast<char>(random());
      else
        changed.erase(at, random() % 40);
    }
    const Result<Palette> read = read_palette(changed, "m.toml");
    EXPECT_TRUE(read ? validate(*read).has_value() : read.error().message.starts_with("m.toml"));
  }
}

// ---- files

std::string refusal_of_file(const std::string& path) {
  const Result<PaletteContent> read = read_palette_file(path);
  return read ? "" : read.error().message;
}

TEST(PaletteFile, a_file_is_read_by_its_path) {
  const TestFolder folder;
  std::ofstream(folder / "m.toml") << builtin_palette_text();
  const Result<PaletteContent> read = read_palette_file(folder / "m.toml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->palette == builtin_palette());
  EXPECT_TRUE(read->files.empty());
}

TEST(PaletteFile, what_is_no_file_or_too_long_is_refused) {
  const TestFolder folder;
  EXPECT_EQ(refusal_of_file(folder / "m.toml"), folder / "m.toml: there is no such file");
  EXPECT_EQ(refusal_of_file(folder / ""), folder / ": it is a folder, not a file");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal_of_file(folder / "pipe"), folder / "pipe: it is a pipe, not a file");
  EXPECT_EQ(refusal_of_file("/dev/zero"), "/dev/zero: it is a device, not a file");
  std::ofstream(folder / "long.toml") << std::string(limits::palette_file_bytes_max + 1, '\n');
  EXPECT_TRUE(refusal_of_file(folder / "long.toml").ends_with("at most 256 KiB"))
      << refusal_of_file(folder / "long.toml");
}

TEST(PaletteFile, an_error_in_a_file_names_its_path) {
  const TestFolder folder;
  std::ofstream(folder / "m.toml") << ground << rock << "friction = 5\n";
  EXPECT_EQ(refusal_of_file(folder / "m.toml"), folder / "m.toml:7: rock: friction 5 is over 2");
}

}  // namespace
}  // namespace scree
