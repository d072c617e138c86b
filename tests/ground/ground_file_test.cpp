// Ground files: what is written is read, whatever the size; what was damaged is refused with a reason.
#include "ground/ground_file.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "ground/ground_writer.h"
#include "tests/support/memory_heights.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

GroundHeader write_ground(const std::string& path, int columns, int rows, int32_t add = 0) {
  const HeightLayout layout{columns, rows, 1.0F, 0, 0, {5.0F, 60.0F}};
  auto writer = GroundWriter::create(path, layout, 12.5F);
  EXPECT_TRUE(writer) << writer.error().message;
  std::vector<int32_t> row(static_cast<size_t>(columns));
  for (int z = 0; z < rows; ++z) {
    for (int x = 0; x < columns; ++x) row[static_cast<size_t>(x)] = rough_height(x, z) + add;
    (*writer)->add_row(row);
  }
  const auto header = (*writer)->finish();
  EXPECT_TRUE(header) << header.error().message;
  return *header;
}

std::vector<char> bytes_in(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put_bytes(const std::string& path, const std::vector<char>& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string refusal_of(const std::string& path) {
  const auto opened = GroundFile::open(path);
  return opened ? std::string() : opened.error().message;
}

TEST(GroundFiles, every_sample_is_read_as_it_was_written_also_where_tiles_end) {
  const TestFolder folder;
  for (const auto& [columns, rows] :
       {std::pair(2, 2), {128, 128}, {129, 127}, {257, 3}, {256, 385}, {300, 260}}) {
    const std::string path = folder / "a.ground";
    const GroundHeader written = write_ground(path, columns, rows);
    const auto file = GroundFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ((*file)->header().ground, written.ground);
    EXPECT_EQ((*file)->header().zero_m, 12.5F);
    const HeightLayout& layout = (*file)->layout();
    for (int z = 0; z < rows; ++z)
      for (int x = 0; x < columns; ++x) {
        const auto tile = (*file)->tile({0, x / tile_samples, z / tile_samples});
        ASSERT_EQ(tile->heights[HeightTile::index(x % tile_samples, z % tile_samples)], rough_height(x, z));
      }
    for (int level = 1; level < layout.levels(); ++level)  // smoothed, so only about
      for (int z = 2; z < HeightLayout::samples_on(level, rows) - 2; ++z)
        for (int x = 2; x < HeightLayout::samples_on(level, columns) - 2; ++x) {
          const auto tile = (*file)->tile({level, x / tile_samples, z / tile_samples});
          ASSERT_NEAR(tile->heights[HeightTile::index(x % tile_samples, z % tile_samples)],
                      rough_height(x << level, z << level), 4000);
        }
  }
}

TEST(GroundFiles, a_ground_is_named_by_all_of_its_samples) {
  const TestFolder folder;
  const Digest name = name_of(write_ground(folder / "a", 300, 200));
  EXPECT_EQ(name_of(write_ground(folder / "b", 300, 200)), name);
  EXPECT_EQ(bytes_in(folder / "a"), bytes_in(folder / "b"));
  EXPECT_NE(name_of(write_ground(folder / "c", 300, 200, 1)), name);
}

TEST(GroundFiles, a_file_that_is_cut_short_anywhere_is_refused) {
  const TestFolder folder;
  const std::string path = folder / "a.ground", cut = folder / "cut.ground";
  write_ground(path, 140, 20);
  std::vector<char> bytes = bytes_in(path);
  for (size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 97) {
    put_bytes(cut, {bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(size)});
    EXPECT_NE(refusal_of(cut).find(cut), std::string::npos) << size;
  }
}

TEST(GroundFiles, a_flipped_bit_anywhere_that_counts_is_refused) {
  const TestFolder folder;
  const std::string path = folder / "a.ground", other = folder / "other.ground";
  const GroundHeader header = write_ground(path, 140, 20);
  const std::vector<char> bytes = bytes_in(path);
  for (size_t at = 0; at < bytes.size(); at += at < header_bytes ? 1 : 41) {
    if (at >= 188 && at < header_bytes) continue;  // zeros
    std::vector<char> flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    put_bytes(other, flipped);
    EXPECT_FALSE(refusal_of(other).empty())
        << "byte " << at << " of " << bytes.size() << ", index at " << header.index_begins;
  }
}

TEST(GroundFiles, foreign_files_other_versions_and_folders_are_named) {
  const TestFolder folder;
  const std::string path = folder / "a.ground";
  write_ground(path, 10, 10);
  std::vector<char> bytes = bytes_in(path);
  bytes[8] = 9;
  put_bytes(path, bytes);
  EXPECT_NE(refusal_of(path).find("format 9"), std::string::npos);
  put_bytes(path, std::vector<char>(5000, 'x'));
  EXPECT_NE(refusal_of(path).find("not a ground file"), std::string::npos);
  EXPECT_FALSE(refusal_of(folder / "").empty());
  EXPECT_FALSE(refusal_of(folder / "none").empty());
  const std::string pipe = folder / "pipe.ground";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(refusal_of(pipe).find("it is a pipe, not a file"), std::string::npos);
}

TEST(GroundFiles, a_writer_that_is_not_finished_leaves_nothing_behind) {
  const TestFolder folder;
  {
    auto writer = GroundWriter::create(folder / "a.ground", {10, 10, 1.0F, 0, 0, {}}, 0.0F);
    ASSERT_TRUE(writer);
    (*writer)->add_row(std::vector<int32_t>(10));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
  EXPECT_FALSE(GroundWriter::create(folder / "no/such/folder.ground", {10, 10, 1.0F, 0, 0, {}}, 0.0F));
}

TEST(GroundFiles, have_a_palette_that_is_a_part_of_their_name) {
  const TestFolder folder;
  Palette palette = builtin_palette();
  palette.rows.back().name = "fresh_snow";
  palette.ground.soil = *palette.named("sand");
  const auto written = [&](const std::string& name, const Palette& of) {
    auto writer = GroundWriter::create(folder / name, {4, 4, 1.0F, 0, 0, {5.0F, 60.0F}}, 0.0F, of);
    EXPECT_TRUE(writer);
    for (int z = 0; z < 4; ++z) (*writer)->add_row(std::vector<int32_t>(4, 0));
    EXPECT_TRUE((*writer)->finish());
    const auto file = GroundFile::open(folder / name);
    EXPECT_TRUE(file) << file.error().message;
    return *file;
  };
  const auto plain = written("plain.ground", builtin_palette()), own = written("own.ground", palette);
  EXPECT_EQ(plain->palette(), shared_builtin_palette());
  EXPECT_EQ(plain->header().format, 1U) << "as before palettes";
  EXPECT_EQ(*own->palette(), palette);
  EXPECT_EQ(own->header().format, 2U);
  EXPECT_NE(own->name(), plain->name());
  EXPECT_EQ(GroundFile::source_of(own).rows.soil, *palette.named("sand"));
  std::vector<char> bytes = bytes_in(folder / "own.ground");
  for (size_t at = 0; at < bytes.size(); at += 37) {
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
    put_bytes(folder / "bad.ground", bytes);
    const bool is_padding = at >= 224 && at < header_bytes;
    EXPECT_TRUE(is_padding || !refusal_of(folder / "bad.ground").empty()) << at;
    bytes[at] = static_cast<char>(bytes[at] ^ 1);
  }
  bytes.resize(header_bytes + 40);
  put_bytes(folder / "bad.ground", bytes);
  EXPECT_FALSE(refusal_of(folder / "bad.ground").empty());
}

}  // namespace
}  // namespace scree
