// A world's file of an older format: a copy is kept before it is saved for the first time, and whatever
// happens meanwhile, one of the two versions opens.
#include "server/store/world_upgrade.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "server/store/database.h"
#include "server/store/world_copy.h"
#include "tests/store/faulty_disk.h"
#include "tests/store/world_file_fixture.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr int64_t older_format = world_format - 1;

class WorldUpgrade : public WorldFileTest {
 protected:
  /// A file as the release before made it: without what the present format has added.
  void make_older() {
    make();
    file.reset();
    run(path, "PRAGMA user_version = " + std::to_string(older_format) + "; DROP TABLE stones;");
  }
  static void run(const std::string& at, const std::string& sql) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(at.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
  }
  static int64_t format_of(const std::string& at) {
    const auto opened = WorldFile::open(at);
    EXPECT_TRUE(opened) << opened.error().message;
    return opened ? (*opened)->format().value_or(-1) : -1;
  }
  Result<void> save_later() {
    const auto opened = WorldFile::open(path);
    if (!opened) return tl::unexpected(opened.error());
    World later(small_world());
    while (later.tick() <= world->tick()) later.step({});
    return (*opened)->save(later.moment(), {});
  }
};

TEST_F(WorldUpgrade, a_checked_copy_of_the_older_file_is_kept_and_the_file_is_brought_up_to_date) {
  make_older();
  const auto before = value_in_file();
  ASSERT_TRUE(save_later());
  EXPECT_EQ(format_of(path), world_format);
  const std::string kept = name_of_older(path);
  EXPECT_EQ(kept, path + ".before-v" + std::to_string(world_format));
  ASSERT_TRUE(fs::exists(kept));
  EXPECT_EQ(format_of(kept), older_format);
  const auto rows = WorldFile::open(kept).value()->read();
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(encode(rows->world), before);
  EXPECT_TRUE(check_world(path, WorldCheck::all_rows));
  for (const char* part : {"-new", "-wal", "-shm"}) EXPECT_FALSE(fs::exists(kept + part)) << part;
}

TEST_F(WorldUpgrade, a_file_of_the_present_format_is_not_copied) {
  make();
  file.reset();
  ASSERT_TRUE(save_later());
  EXPECT_FALSE(fs::exists(name_of_older(path)));
}

TEST_F(WorldUpgrade, a_copy_of_the_same_moment_is_taken_for_it_and_another_one_stays_beside_it) {
  make_older();
  ASSERT_TRUE(keep_older_world(path));
  const auto written = fs::last_write_time(name_of_older(path));
  ASSERT_TRUE(keep_older_world(path));
  EXPECT_EQ(fs::last_write_time(name_of_older(path)), written);
  EXPECT_FALSE(fs::exists(name_of_older(path, 2)));
  std::ofstream(name_of_older(path), std::ios::trunc) << "no world";
  ASSERT_TRUE(save_later());
  EXPECT_TRUE(fs::exists(name_of_older(path, 2)));
  EXPECT_EQ(fs::file_size(name_of_older(path)), 8U) << "what is there stays";
}

/// At any write the disk dies: then the old file or the new one opens, and the new one has its copy.
TEST_F(WorldUpgrade, a_disk_that_dies_at_any_write_leaves_either_version) {
  make_older();
  const auto before = value_in_file();
  const std::string original = folder / "original";
  fs::copy_file(path, original);
  bool died = true;
  uint64_t deaths = 0, saves = 0;
  for (uint64_t writes = 1; died; ++writes) {
    {
      FaultyDisk disk;
      disk.dies_after = writes;
      saves += save_later() ? 1 : 0;
      died = disk.dead();
      deaths += died ? 1 : 0;
      disk.crash();
    }
    const int64_t format = format_of(path);
    const auto rows = WorldFile::open(path).value()->read();
    ASSERT_TRUE(rows) << writes << ": " << rows.error().message;
    if (format == older_format) {
      EXPECT_EQ(encode(rows->world), before) << writes;
    } else {
      EXPECT_EQ(format, world_format);
      EXPECT_TRUE(check_world(name_of_older(path), WorldCheck::all_rows)) << writes;
    }
    for (const auto& entry : fs::directory_iterator(folder / ""))
      if (entry.path() != original) fs::remove(entry.path());
    fs::copy_file(original, path);
  }
  EXPECT_GT(deaths, 10U);
  EXPECT_GE(saves, 1U);
}

TEST_F(WorldUpgrade, a_full_disk_refuses_the_save_and_changes_nothing) {
  make_older();
  const auto before = value_in_file();
  {
    FaultyDisk disk;
    disk.full = true;
    const auto saved = save_later();
    ASSERT_FALSE(saved);
    EXPECT_NE(saved.error().message.find("the disk is full"), std::string::npos) << saved.error().message;
  }
  EXPECT_EQ(format_of(path), older_format);
  EXPECT_EQ(value_in_file(), before);
  EXPECT_FALSE(fs::exists(name_of_older(path)));
  ASSERT_TRUE(save_later()) << "once there is room";
}

/// Who saves meanwhile is not kept out.
TEST_F(WorldUpgrade, a_copy_in_parts_is_of_one_moment_while_another_one_saves) {
  make();
  ASSERT_TRUE(file->save(world->moment(), {}));
  const auto before = value_in_file();
  uint32_t parts = 0;
  const auto save_between = [&] {
    world->step({});
    EXPECT_TRUE(file->save(world->moment(), {}));
    ++parts;
    return true;
  };
  const std::string to = folder / "copy.world";
  {
    auto source = Database::open(path);
    ASSERT_TRUE(source && source->execute("BEGIN") && source->number("SELECT count(*) FROM moment"));
    const auto copied = source->copy_to(to, {1, save_between});
    ASSERT_TRUE(copied) << copied.error().message;
  }
  EXPECT_GT(parts, 3U);
  const auto rows = WorldFile::open(to).value()->read();
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(encode(rows->world), before);
  EXPECT_GT(check_world(path, WorldCheck::all_rows)->tick, rows->world.moment.tick);
}

TEST_F(WorldUpgrade, a_copy_that_is_given_up_or_is_of_no_world_leaves_nothing) {
  make();
  auto source = Database::open(path);
  ASSERT_TRUE(source);
  EXPECT_FALSE(source->copy_to(folder / "half.world", {1, [] { return false; }}));
  const std::string no_world = folder / "no.world", to = folder / "copy.world";
  std::ofstream(no_world) << "no world at all";
  EXPECT_FALSE(copy_checked(no_world, to, WorldCheck::all_rows));
  EXPECT_FALSE(copy_checked(path, no_world, WorldCheck::all_rows)) << "it exists";
  run(path, "UPDATE chunks SET checksum = checksum + 1");
  const auto copied = copy_checked(path, to, WorldCheck::all_rows);
  ASSERT_FALSE(copied);
  EXPECT_NE(copied.error().message.find("damaged"), std::string::npos) << copied.error().message;
  EXPECT_FALSE(fs::exists(to) || fs::exists(to + "-new"));
}

}  // namespace
}  // namespace scree
