// A damaged file's rows: those in sound pages are found, and what is lost is named.
#include "server/store/readable_rows.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include "server/store/world_schema.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

constexpr uint64_t rows = 2000;
constexpr uint64_t key_step = 1000;  // keys lie apart, as those of chunks do
constexpr size_t page_bytes = 4096;

struct Found {
  std::set<uint64_t> keys;
  std::set<uint64_t> damaged;  ///< read, but not as they were written
  std::vector<std::pair<uint64_t, uint64_t>> lost;
};

struct ReadableRowsTest : testing::Test {
  ReadableRowsTest() {
    auto file = Database::create(path);
    EXPECT_TRUE(file && file->execute("PRAGMA page_size = 4096; BEGIN;" + world_schema::create_tables()));
    const auto put = file->prepare(world_schema::put_into("chunks"));
    const std::vector<uint8_t> data(300, 7);
    for (uint64_t i = 1; i <= rows; ++i) EXPECT_TRUE(file->put(*put, i * key_step, data));
    EXPECT_TRUE(file->execute("COMMIT"));
  }

  void overwrite_page(size_t page) const {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(page * page_bytes));
    const std::array<char, page_bytes> zeros{};
    file.write(zeros.data(), zeros.size());
  }

  static Found read(const std::string& file) {
    Found found;
    auto database = Database::open(file);
    EXPECT_TRUE(database.has_value());
    const auto add_row = [&](uint64_t key, auto, bool whole) -> Result<void> {
      EXPECT_TRUE((whole ? found.keys : found.damaged).insert(key).second);
      return {};
    };
    const auto lose = [&](uint64_t first, uint64_t last, const std::string&) {
      found.lost.emplace_back(first, last);
    };
    EXPECT_TRUE(each_readable(*database, world_schema::all_from("chunks"), add_row, lose));
    for (uint64_t i = 1; i <= rows; ++i) {
      const uint64_t key = i * key_step;
      const bool is_lost = found.damaged.contains(key) ||
                           std::any_of(found.lost.begin(), found.lost.end(), [&](const auto& range) {
                             return key >= range.first && key <= range.second;
                           });
      EXPECT_NE(found.keys.contains(key), is_lost) << key;
    }
    return found;
  }

  TestFolder folder;
  std::string path = folder / "file";
};

TEST_F(ReadableRowsTest, a_sound_file_loses_nothing) {
  const Found found = read(path);
  EXPECT_EQ(found.keys.size(), rows);
  EXPECT_TRUE(found.lost.empty());
}

TEST_F(ReadableRowsTest, of_damaged_pages_only_their_rows_are_lost) {
  for (const size_t page : {60U, 61U, 100U}) overwrite_page(page);
  const Found found = read(path);
  EXPECT_FALSE(found.lost.empty());
  EXPECT_GT(found.keys.size(), rows - 3 * page_bytes / 300 - 3);
  EXPECT_LT(found.keys.size(), rows);
}

TEST_F(ReadableRowsTest, a_file_that_was_cut_is_read_as_far_as_it_goes) {
  const uint64_t bytes = std::filesystem::file_size(path);
  std::filesystem::resize_file(path, bytes * 2 / 3 + 100);
  const std::string copy = folder / "copy";
  ASSERT_TRUE(copy_for_reading(path, copy).has_value());
  EXPECT_EQ(std::filesystem::file_size(copy), bytes);
  EXPECT_EQ(std::filesystem::file_size(path), bytes * 2 / 3 + 100);
  const Found found = read(copy);
  EXPECT_GT(found.keys.size(), rows / 2);
  EXPECT_FALSE(found.lost.empty());
}

}  // namespace
}  // namespace scree
