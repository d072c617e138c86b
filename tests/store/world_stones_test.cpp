// Stones where pieces merged, as rows of a world's file.
#include "server/formats/world_stones.h"

#include <gtest/gtest.h>

#include "server/store/database.h"
#include "server/world/limits.h"
#include "tests/store/world_file_fixture.h"

namespace scree {
namespace {

/// A world in which all pieces have merged.
std::unique_ptr<World> settled_world() {
  auto world = busy_world();
  for (int tick = 0; tick < 1800 && !world->moment().pieces.empty(); ++tick) world->step({});
  return world;
}

class WorldStonesTest : public testing::Test {
 protected:
  void SetUp() override {
    world = settled_world();
    ASSERT_GE(world->moment().stones.size(), 3U);
    auto made = WorldFile::create(path, header_of(world->snapshot()), world->snapshot());
    ASSERT_TRUE(made.has_value()) << made.error().message;
    file = std::move(*made);
  }
  WorldRows rows() const {
    auto reopened = WorldFile::open(path);
    EXPECT_TRUE(reopened.has_value());
    auto read = (*reopened)->read();
    EXPECT_TRUE(read.has_value()) << read.error().message;
    return std::move(*read);
  }
  std::vector<SettledStone> in_file() const { return rows().world.moment.stones; }
  void change(const std::string& sql) {
    file.reset();
    auto database = Database::open(path);
    ASSERT_TRUE(database.has_value());
    const auto done = database->execute(sql);
    ASSERT_TRUE(done.has_value()) << done.error().message;
  }
  static void expect_same(const std::vector<SettledStone>& a, const std::vector<SettledStone>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(encode(a[i]), encode(b[i]));
  }

  TestFolder folder;
  const std::string path = folder / "world.scree";
  std::unique_ptr<World> world;
  std::unique_ptr<WorldFile> file;
};

TEST_F(WorldStonesTest, are_read_as_they_were_saved_and_a_restored_world_has_them) {
  expect_same(in_file(), world->moment().stones);
  const auto restored = World::restore(rows().world);
  ASSERT_TRUE(restored.has_value());
  expect_same((*restored)->moment().stones, world->moment().stones);
}

TEST_F(WorldStonesTest, a_save_writes_those_that_are_new_and_drops_those_that_ended) {
  WorldMoment moment = world->moment();
  moment.stones.erase(moment.stones.begin());
  ASSERT_TRUE(file->save(moment, {}).has_value());
  const uint64_t written = file->bytes_written();
  ASSERT_TRUE(file->save(moment, {}).has_value());
  auto bare = WorldFile::open(path);
  ASSERT_TRUE(bare.has_value());
  expect_same((*(*bare)->read_moment()).world.moment.stones, moment.stones);
  EXPECT_LT(file->bytes_written() - written, encode(moment).size() + 1000) << "no stone is written twice";
}

TEST_F(WorldStonesTest, a_file_of_an_older_release_has_none_and_gets_them_with_the_next_save) {
  change("DROP TABLE stones");
  EXPECT_TRUE(in_file().empty());
  auto opened = WorldFile::open(path);
  ASSERT_TRUE(opened.has_value());
  ASSERT_TRUE((*opened)->save(world->moment(), {}).has_value());
  expect_same(in_file(), world->moment().stones);
}

TEST_F(WorldStonesTest, a_damaged_row_is_left_out_and_told_and_the_world_goes_on) {
  change("UPDATE stones SET checksum = 0 WHERE key = (SELECT min(key) FROM stones)");
  const WorldRows read = rows();
  EXPECT_EQ(read.world.moment.stones.size() + 1, world->moment().stones.size());
  EXPECT_EQ(read.stones_left_out, 1U);
  EXPECT_NE(read.stone_left_out.find("is not what was saved"), std::string::npos) << read.stone_left_out;
  EXPECT_TRUE(World::restore(read.world).has_value());
}

TEST_F(WorldStonesTest, hostile_rows_are_left_out) {
  SettledStone stone = world->moment().stones.front();
  std::vector<std::vector<uint8_t>> hostile;
  stone.lies = 0;
  hostile.push_back(encode(stone));
  stone.lies = 1;
  stone.pose.x = std::numeric_limits<int32_t>::min();
  hostile.push_back(encode(stone));
  hostile.push_back({1, 2, 3});
  hostile.push_back({});
  for (const std::vector<uint8_t>& row : hostile) EXPECT_FALSE(decode_stone(row).has_value());
  auto database = Database::open(path);
  ASSERT_TRUE(database.has_value());
  const auto put = database->prepare("REPLACE INTO stones (key, data, checksum) VALUES (?1, ?2, ?3)");
  ASSERT_TRUE(put.has_value());
  const std::vector<uint8_t> good = encode(world->moment().stones.front());
  ASSERT_TRUE(database->put(*put, 1000000, good).has_value());
  for (size_t i = 0; i < hostile.size(); ++i)
    ASSERT_TRUE(database->put(*put, 1000001 + i, hostile[i]).has_value());
  const WorldRows read = rows();
  EXPECT_EQ(read.stones_left_out, 5U) << "another piece's, too";
  expect_same(read.world.moment.stones, world->moment().stones);
}

TEST_F(WorldStonesTest, more_rows_than_a_world_keeps_are_left_out) {
  auto database = Database::open(path);
  ASSERT_TRUE(database.has_value());
  const auto put = database->prepare("REPLACE INTO stones (key, data, checksum) VALUES (?1, ?2, ?3)");
  ASSERT_TRUE(put.has_value() && database->execute("BEGIN").has_value());
  SettledStone stone = world->moment().stones.front();
  for (PieceId id = 100000; id < 100000 + limits::kept_stones_max; ++id) {
    stone.id = id;
    ASSERT_TRUE(database->put(*put, id, encode(stone)).has_value());
  }
  ASSERT_TRUE(database->execute("COMMIT").has_value());
  const WorldRows read = rows();
  EXPECT_EQ(read.world.moment.stones.size(), limits::kept_stones_max);
  EXPECT_EQ(read.stones_left_out, world->moment().stones.size());
  EXPECT_NE(read.stone_left_out.find("limits.kept_stones_max"), std::string::npos) << read.stone_left_out;
}

}  // namespace
}  // namespace scree
