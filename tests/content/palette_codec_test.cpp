// Palettes as bytes: all that a palette has survives, and nothing else is taken.
#include "proto/palette_codec.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <regex>

#include "content/builtin_palette.h"
#include "content/files/palette_file.h"
#include "content/palette_text.h"
#include "crypto/sha256.h"
#include "shared/material/material_members.h"
#include "tests/content/small_palette.h"

namespace scree {
namespace {

std::string refusal_of_bytes(const Palette& palette) {
  const Result<Palette> decoded = decode_palette(encode_palette(palette));
  if (!decoded) return decoded.error().message;
  EXPECT_TRUE(*decoded == palette);
  return "";
}

TEST(PaletteCodec, the_built_in_palette_survives) {
  EXPECT_EQ(refusal_of_bytes(builtin_palette()), "");
}

TEST(PaletteCodec, every_number_and_every_choice_survives) {
  for (const MaterialNumber& member : material_numbers())
    for (const float value : {member.least, member.most, 0.5F * (member.least + member.most)}) {
      Palette palette = small_palette();
      member.put(palette.rows[1], value);
      EXPECT_EQ(refusal_of_bytes(palette), "") << member.name;
    }
  for (const MaterialChoice& member : material_choices())
    for (size_t value = 0; value < member.values.size(); ++value) {
      Palette palette = small_palette();
      member.put(palette.rows[1], static_cast<uint8_t>(value));
      EXPECT_EQ(refusal_of_bytes(palette), "") << member.name;
    }
  for (const GroundNumber& member : ground_numbers()) {
    Palette palette = small_palette();
    member.put(palette.ground, member.most);
    EXPECT_EQ(refusal_of_bytes(palette), "") << member.name;
  }
}

TEST(PaletteCodec, layers_and_images_survive) {
  Palette palette = palette_of(materials_max);
  palette.ground = {Material{254}, Material{7}, Material{128}, 0.0F, 50.0F};
  palette.rows[3].look.albedo = sha256({});
  palette.rows[254].look.normal = Digest{};
  EXPECT_EQ(refusal_of_bytes(palette), "");
}

TEST(PaletteCodec, the_largest_palette_keeps_its_limit) {
  Palette palette = palette_of(materials_max);
  for (MaterialRow& row : palette.rows) {
    row.name += std::string(material_name_max - row.name.size(), 'x');
    for (const MaterialNumber& member : material_numbers()) member.put(row, member.most);
    for (const MaterialChoice& member : material_choices())
      member.put(row, static_cast<uint8_t>(member.values.size() - 1));
    row.look.albedo = row.look.normal = sha256({});
  }
  EXPECT_EQ(refusal_of_bytes(palette), "");
  EXPECT_LT(encode_palette(palette).size(), palette_bytes_max / 2);
}

TEST(PaletteCodec, a_number_beyond_its_bounds_is_refused) {
  for (const MaterialNumber& member : material_numbers())
    for (const float value : {std::nextafter(member.least, -INFINITY), std::nextafter(member.most, INFINITY),
                              std::nanf(""), INFINITY}) {
      Palette palette = small_palette();
      member.put(palette.rows[1], value);
      EXPECT_TRUE(refusal_of_bytes(palette).starts_with("the palette: sand: " + std::string(member.name)))
          << refusal_of_bytes(palette);
    }
}

TEST(PaletteCodec, a_choice_after_the_last_is_refused) {
  for (const MaterialChoice& member : material_choices()) {
    Palette palette = small_palette();
    member.put(palette.rows[0], static_cast<uint8_t>(member.values.size()));
    EXPECT_TRUE(refusal_of_bytes(palette).starts_with("the palette: rock: " + std::string(member.name)))
        << refusal_of_bytes(palette);
  }
}

TEST(PaletteCodec, no_rows_too_many_rows_and_missing_rows_are_refused) {
  EXPECT_EQ(refusal_of_bytes(Palette{}), "the palette: a palette has at least one material");
  EXPECT_EQ(decode_palette({}).error().message, "the palette: a palette has at least one material");
  EXPECT_EQ(refusal_of_bytes(palette_of(256)), "the palette: 256 materials are over the limit of 255");
  Palette palette = small_palette();
  palette.ground.soil = Material{9};
  EXPECT_EQ(refusal_of_bytes(palette), "the palette: ground: soil is material 9, and the palette has 2");
}

TEST(PaletteCodec, more_bytes_than_the_limit_are_refused_unread) {
  const std::vector<uint8_t> bytes(palette_bytes_max + 1);
  EXPECT_EQ(decode_palette(bytes).error().message, "the palette has 131073 bytes, over the limit of 131072");
}

/// What is taken is a valid palette, and reads as itself.
void expect_sound(std::span<const uint8_t> bytes) {
  const Result<Palette> decoded = decode_palette(bytes);
  if (!decoded) {
    EXPECT_TRUE(decoded.error().message.starts_with("the palette")) << decoded.error().message;
    return;
  }
  EXPECT_TRUE(validate(*decoded));
  EXPECT_EQ(refusal_of_bytes(*decoded), "");
}

TEST(PaletteCodec, no_truncation_is_taken_for_the_whole) {
  const Palette& palette = builtin_palette();
  const std::vector<uint8_t> bytes = encode_palette(palette);
  for (size_t length = 0; length < bytes.size(); ++length) {
    const auto cut = std::span(bytes).first(length);
    expect_sound(cut);
    const Result<Palette> decoded = decode_palette(cut);
    EXPECT_FALSE(decoded && *decoded == palette) << length;
  }
}

TEST(PaletteCodec, no_changed_byte_makes_an_unsound_palette) {
  const std::vector<uint8_t> bytes = encode_palette(small_palette());
  for (size_t at = 0; at < bytes.size(); ++at)
    for (int value = 0; value < 256; ++value) {
      std::vector<uint8_t> changed = bytes;
      changed[at] = static_cast<uint8_t>(value);
      expect_sound(changed);
    }
}

TEST(PaletteCodec, no_many_changed_bytes_make_an_unsound_palette) {
  std::mt19937 random(20);
  const std::vector<uint8_t> bytes = encode_palette(builtin_palette());
  for (int round = 0; round < 2000; ++round) {
    std::vector<uint8_t> changed = bytes;
    for (uint32_t i = 0; i <= random() % 6; ++i)
      changed[random() % changed.size()] = static_cast<uint8_t>(random());
    expect_sound(changed);
  }
}

TEST(PaletteCodec, a_digest_of_another_length_is_refused) {
  Palette palette = small_palette();
  palette.rows[0].look.albedo = Digest{1, 2, 3};
  std::vector<uint8_t> bytes = encode_palette(palette);
  const std::vector<uint8_t> begin{0x42, 32, 1, 2, 3};  // field 8 of 32 bytes
  const auto found = std::search(bytes.begin(), bytes.end(), begin.begin(), begin.end());
  ASSERT_NE(found, bytes.end());
  *(found + 1) = 2;
  // The bytes that follow are no fields then, so the message is damaged or its digest too short.
  EXPECT_FALSE(decode_palette(bytes));
}

TEST(PaletteCodec, the_digest_is_that_of_the_bytes_and_tells_palettes_apart) {
  Palette palette = small_palette();
  const Digest digest = palette_digest(palette);
  EXPECT_EQ(digest, sha256(encode_palette(palette)));
  EXPECT_EQ(digest, palette_digest(small_palette()));
  palette.rows[1].friction = std::nextafter(palette.rows[1].friction, 2.0F);
  EXPECT_NE(digest, palette_digest(palette));
}

/// Names of the values of an enum of material.proto, in order, without their prefix and in lower case.
std::vector<std::string> names_in_proto(const std::string& kind, const std::string& prefix) {
  std::ifstream in(std::string(SCREE_SOURCE_DIR) + "/proto/material.proto");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const size_t begin = text.find("enum " + kind + " {"), end = text.find('}', begin);
  const std::string body = text.substr(begin, end - begin);
  const std::regex value(prefix + R"(_([A-Z]+) = ([0-9]+);)");
  std::vector<std::string> names;
  for (std::sregex_iterator it(body.begin(), body.end(), value), last; it != last; ++it) {
    EXPECT_EQ((*it)[2], std::to_string(names.size()));
    std::string name = (*it)[1];
    std::ranges::transform(name, name.begin(), [](char c) { return static_cast<char>(c - 'A' + 'a'); });
    names.push_back(name);
  }
  return names;
}

template <typename Kind>
std::vector<std::string> names_in_table() {
  return {kind_names<Kind>.begin(), kind_names<Kind>.end()};
}

TEST(PaletteCodec, the_specification_names_the_same_kinds) {
  EXPECT_EQ(names_in_proto("BreakLook", "BREAKS"), names_in_table<BreakLook>());
  EXPECT_EQ(names_in_proto("GrainAxis", "AXIS"), names_in_table<GrainAxis>());
  EXPECT_EQ(names_in_proto("SurfacePattern", "PATTERN"), names_in_table<SurfacePattern>());
}

/// A palette's digest is its name: equal ones have equal bytes.
TEST(PaletteCodec, zero_has_no_sign) {
  const auto bytes_with = [](float zero) {
    Palette palette = small_palette();
    palette.rows[0].friction = palette.rows[1].look.roughness = zero;
    palette.ground.cap_depth_m = zero;
    return encode_palette(palette);
  };
  const auto decoded = decode_palette(bytes_with(-0.0F));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(encode_palette(*decoded), bytes_with(0.0F));
  const std::string ground = "[ground]\nbulk = 'a'\nsoil = 'a'\ncap = 'a'\n";
  const std::string row = "[[material]]\nname = 'a'\n";
  const auto plain = read_palette(ground + "cap_depth_m = 0.0\nsoil_depth_m = 0.0\n" + row, "plain");
  const auto with_sign = read_palette(ground + "cap_depth_m = -0.0\nsoil_depth_m = -0.0\n" + row, "sign");
  ASSERT_TRUE(plain && with_sign);
  EXPECT_EQ(encode_palette(*with_sign), encode_palette(*plain));
}

}  // namespace
}  // namespace scree
