// Images of a palette: those in the folder of its file, within their limits, come with it; no other file is
// read.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "content/files/palette_file.h"
#include "content/palette_text.h"
#include "crypto/sha256.h"
#include "shared/material/material_image.h"
#include "tests/support/png_bytes.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

std::vector<uint8_t> bytes_of(const std::string& text) {
  return {text.begin(), text.end()};
}

std::string refusal_of_image(const std::string& png) {
  const auto checked = check_image(bytes_of(png));
  return checked ? "" : checked.error().message;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A folder with a palette whose rock names an image.
class PaletteImages : public ::testing::Test {
 protected:
  Result<PaletteContent> read(const std::string& image) const {
    return read_lines("look.albedo = \"" + image + "\"\n");
  }
  Result<PaletteContent> read_lines(const std::string& lines) const {
    write(folder_ / "m.toml",
          "[ground]\nbulk = \"rock\"\nsoil = \"rock\"\ncap = \"rock\"\n[[material]]\nname = \"rock\"\n" +
              lines);
    return read_palette_file(folder_ / "m.toml");
  }
  std::string refusal(const std::string& image) const {
    const Result<PaletteContent> content = read(image);
    if (content) return "";
    const std::string place = folder_ / "m.toml:7: rock: look.albedo: ", said = content.error().message;
    EXPECT_TRUE(said.starts_with(place)) << said;
    return said.substr(std::min(place.size(), said.size()));
  }

  TestFolder folder_;
};

TEST_F(PaletteImages, come_with_the_palette_by_their_digest) {
  const std::string one = png_bytes(1, 1), large = png_bytes(4096, 4096, limits::image_bytes_max);
  write(folder_ / "one.png", one);
  std::filesystem::create_directory(folder_ / "normals");
  write(folder_ / "normals/large.png", large);
  const auto content = read_lines("[material.look]\nalbedo = \"one.png\"\nnormal = \"normals/large.png\"\n");
  ASSERT_TRUE(content) << content.error().message;
  const MaterialLook& look = content->palette.rows.front().look;
  EXPECT_EQ(look.albedo, sha256(bytes_of(one)));
  EXPECT_EQ(look.normal, sha256(bytes_of(large)));
  ASSERT_EQ(content->files.size(), 2U);
  EXPECT_EQ(content->files.at(*look.albedo), bytes_of(one));
  EXPECT_EQ(content->files.at(*look.normal), bytes_of(large));
}

TEST_F(PaletteImages, of_the_same_bytes_come_once) {
  write(folder_ / "a.png", png_bytes(2, 2));
  write(folder_ / "b.png", png_bytes(2, 2));
  const auto content = read_lines("[material.look]\nalbedo = \"a.png\"\nnormal = \"b.png\"\n");
  ASSERT_TRUE(content) << content.error().message;
  EXPECT_EQ(content->files.size(), 1U);
}

TEST_F(PaletteImages, outside_the_folder_are_refused) {
  write(folder_ / "a.png", png_bytes(1, 1));
  for (const std::string& path : {std::string("../a.png"), std::string("x/../a.png"),
                                  std::string("x/../../a.png"), std::string(".."), folder_ / "a.png"})
    EXPECT_EQ(refusal(path), path + ": images lie in the folder of the palette's file, or below it");
}

TEST_F(PaletteImages, behind_a_link_out_of_the_folder_are_refused) {
  const std::string outside = (folder_ / "outside.png"), inner = folder_ / "inner";
  write(outside, png_bytes(1, 1));
  std::filesystem::create_directory(inner);
  std::filesystem::create_symlink(outside, inner + "/link.png");
  write(inner + "/a.png", png_bytes(1, 1));
  std::filesystem::create_symlink("a.png", inner + "/near.png");
  std::filesystem::rename(inner, folder_ / "inner_2");
  const auto read_inner = [&](const std::string& image) {
    write(folder_ / "inner_2/m.toml",
          "[ground]\nbulk = \"rock\"\nsoil = \"rock\"\ncap = \"rock\"\n[[material]]\n"
          "name = \"rock\"\nlook.albedo = \"" +
              image + "\"\n");
    return read_palette_file(folder_ / "inner_2/m.toml");
  };
  EXPECT_TRUE(read_inner("near.png"));
  const auto linked = read_inner("link.png");
  ASSERT_FALSE(linked);
  EXPECT_TRUE(
      linked.error().message.ends_with("link.png: it is a link that leads out of the palette's folder"));
}

TEST_F(PaletteImages, that_are_no_regular_files_are_refused) {
  EXPECT_EQ(refusal("a.png"), "a.png: there is no such file");
  std::filesystem::create_directory(folder_ / "a.png");
  EXPECT_EQ(refusal("a.png"), "a.png: it is a folder, not a file");
  ASSERT_EQ(::mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  EXPECT_EQ(refusal("pipe.png"), "pipe.png: it is a pipe, not a file");
}

TEST_F(PaletteImages, whose_path_is_odd_are_refused) {
  write(folder_ / "a.png", png_bytes(1, 1));
  EXPECT_TRUE(refusal("").starts_with("the path of an image has 1 to 200 bytes"));
  EXPECT_TRUE(refusal(std::string(201, 'a')).starts_with("the path of an image has 1 to 200 bytes"));
  EXPECT_TRUE(refusal("a.png\\u0000b").starts_with("the path of an image "));
}

TEST_F(PaletteImages, beyond_their_limits_are_refused_before_they_are_decoded) {
  write(folder_ / "wide.png", png_header(30000, 30000));
  EXPECT_EQ(refusal("wide.png"),
            "wide.png: the image has 30000 × 30000 pixels, over the limit of 4096 × 4096");
  write(folder_ / "long.png", png_bytes(1, 1, limits::image_bytes_max + 1));
  EXPECT_EQ(refusal("long.png"), "long.png: the image has 4097 KiB, over the limit of 4096 KiB");
  write(folder_ / "text.png", "no image");
  EXPECT_EQ(refusal("text.png"), "text.png: the image is no PNG");
}

TEST_F(PaletteImages, that_are_damaged_are_refused_before_a_world_is_made) {
  const std::string whole = png_bytes(100, 100);
  std::string header = whole, pixels = whole;
  header[30] = static_cast<char>(header[30] ^ 1);  // the CRC of IHDR
  pixels[pixels.size() - 14] = static_cast<char>(pixels[pixels.size() - 14] ^ 1);
  const auto words = [&](const std::string& png) {
    write(folder_ / "a.png", png);
    return refusal("a.png");
  };
  EXPECT_EQ(words(whole), "");
  for (const std::string& damaged :
       {whole.substr(0, 60), whole.substr(0, whole.size() - 30), header, pixels, png_bytes(100, 100, 0, 40)})
    EXPECT_TRUE(words(damaged).starts_with("a.png: the image is damaged: ")) << words(damaged);
}

TEST_F(PaletteImages, are_64_mebibytes_in_all_at_most) {
  std::string lines;
  const size_t most = limits::palette_images_bytes_max / limits::image_bytes_max;
  for (size_t i = 0; i <= most; ++i) {
    const std::string name = std::to_string(i) + ".png";
    std::string png = png_bytes(1, 1, limits::image_bytes_max);
    png.back() = static_cast<char>(i);
    write(folder_ / name, png);
    if (i > 0) lines += "[[material]]\nname = \"m" + std::to_string(i) + "\"\n";
    lines += "look.albedo = \"" + name + "\"\n";
    const auto content = read_lines(lines);
    ASSERT_EQ(content.has_value(), i < most) << i;
    if (i == most) {
      EXPECT_TRUE(content.error().message.ends_with("over the limit of 64 MiB in all"));
    }
  }
}

TEST_F(PaletteImages, are_refused_of_a_text_without_a_folder_or_as_a_number) {
  const std::string text =
      "[ground]\nbulk = \"rock\"\nsoil = \"rock\"\ncap = \"rock\"\n[[material]]\nname = \"rock\"\n";
  EXPECT_EQ(read_palette(text + "look.albedo = \"a.png\"\n", "m.toml").error().message,
            "m.toml:7: rock: look.albedo is of a palette's file, which has a folder");
  EXPECT_EQ(read_palette(text + "look.normal = 1\n", "m.toml").error().message,
            "m.toml:7: rock: look.normal must be a text, and is a number");
}

TEST(MaterialImage, a_header_says_the_size) {
  EXPECT_EQ(check_image(bytes_of(png_header(1, 1))), (ImageSize{1, 1}));
  EXPECT_EQ(check_image(bytes_of(png_header(4096, 3))), (ImageSize{4096, 3}));
  EXPECT_EQ(refusal_of_image(png_header(4097, 1)),
            "the image has 4097 × 1 pixels, over the limit of 4096 × 4096");
  EXPECT_EQ(refusal_of_image(png_header(1, 0x80000001U)),
            "the image has 1 × 2147483649 pixels, over the limit of 4096 × 4096");
  EXPECT_EQ(refusal_of_image(png_header(0, 1)), "the image is a PNG without pixels");
  EXPECT_EQ(refusal_of_image(png_header(1, 0)), "the image is a PNG without pixels");
}

TEST(MaterialImage, every_truncation_and_every_other_beginning_is_refused) {
  const std::string png = png_header(1, 1).substr(0, 29);
  for (size_t length = 0; length < png.size(); ++length)
    EXPECT_EQ(refusal_of_image(png.substr(0, length)), "the image is no PNG");
  EXPECT_EQ(refusal_of_image(png), "");
  for (size_t at = 0; at < 16; ++at) {
    std::string changed = png;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    EXPECT_EQ(refusal_of_image(changed), "the image is no PNG");
  }
}

}  // namespace
}  // namespace scree
