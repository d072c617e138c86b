// Backups that a server makes by itself: whole copies in a folder, the newest so many of them; and what is
// said when none can be made.
#include "server/app/backups.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "server/app/live_server.h"
#include "server/store/world_copy.h"
#include "shared/base/length_of_time.h"
#include "tests/support/captured_log.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"
#include "tests/support/web_client.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

TEST(LengthOfTime, is_a_whole_number_with_a_unit_within_bounds) {
  EXPECT_EQ(seconds_of("90s", 1.0, 1e6).value_or(0.0), 90.0);
  EXPECT_EQ(seconds_of("10m", 1.0, 1e6).value_or(0.0), 600.0);
  EXPECT_EQ(seconds_of("2h", 1.0, 1e6).value_or(0.0), 7200.0);
  EXPECT_EQ(seconds_of("1d", 1.0, 1e6).value_or(0.0), 86400.0);
  for (const char* wrong : {"", "s", "10", "1.5h", "-1h", "1w", "2d ", "99999999999s"})
    EXPECT_FALSE(seconds_of(wrong, 1.0, 1e6)) << wrong;
  EXPECT_TRUE(holds(seconds_of("1s", 60.0, 86400.0).error().message, "from 1m to 1d"));
}

TEST(BackupFolder, the_newest_stay_by_the_time_in_their_names_and_other_files_are_left_alone) {
  const TestFolder folder;
  const BackupFolder backups(folder / "hill.world", folder / "kept");
  fs::create_directory(folder / "kept");
  EXPECT_TRUE(backups.path_at(1'796'036'400).ends_with("/hill-20261130T110000Z.world")) << backups.path_at(0);
  for (const uint64_t at : {3000U, 1000U, 4000U, 2000U}) std::ofstream(backups.path_at(at)) << "x";
  for (const char* other : {"other-20261130T110000Z.world", "hill-notes.world", "hill.world",
                            "hill-20261130T110000Z.world.txt", "hill-2026113XT110000Z.world"})
    std::ofstream((folder / "kept/") + other) << "x";
  std::ofstream(backups.path_at(5000) + "-new") << "half";
  ASSERT_EQ(backups.list().size(), 4U);
  EXPECT_EQ(backups.list().front().unix_s, 1000U);
  ASSERT_TRUE(backups.keep_newest(2, 4000));
  ASSERT_EQ(backups.list().size(), 2U);
  EXPECT_EQ(backups.list().front().unix_s, 3000U);
  std::ofstream(backups.path_at(3500)) << "x";
  ASSERT_TRUE(backups.keep_newest(2, 3500));
  ASSERT_EQ(backups.list().size(), 2U);
  EXPECT_EQ(backups.list().back().unix_s, 3500U) << "4000 was made before the clock was set back";
  backups.remove_unfinished();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "kept"), fs::directory_iterator()), 7);
}

class LiveBackups : public ::testing::Test {
 protected:
  void start(double every_s, uint32_t keep) {
    server.reset();  // which lets go of its world
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.sim_threads = 1;
    config.world_path = world;
    config.backups = {every_s, keep, folder / "kept"};
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server = std::move(*started);
  }
  std::vector<BackupFolder::Backup> list() const { return BackupFolder(world, folder / "kept").list(); }
  static bool comes(const std::function<bool()>& what) {
    for (const Within within(60.0); !what(); wait_a_moment())
      if (within.over()) return false;
    return true;
  }
  std::string health() const { return HttpClient(server->port()).get("/healthz").body; }

  TestFolder folder;
  std::string world = folder / "hill.world";
  std::unique_ptr<LiveServer> server;
};

TEST_F(LiveBackups, a_whole_copy_is_made_at_once_and_none_by_a_start_that_follows) {
  start(3600.0, 3);
  ASSERT_TRUE(comes([&] { return list().size() == 1; }));
  ASSERT_TRUE(server->stop());
  const std::string path = list().front().path;
  EXPECT_TRUE(check_world(path, WorldCheck::all_rows));
  start(3600.0, 3);
  ASSERT_TRUE(comes([&] { return server->report().ticks > 10; }));
  ASSERT_TRUE(server->stop());
  EXPECT_EQ(list().size(), 1U) << "the one that is there is young enough";
  fs::copy_file(path, folder / "again.world");
  world = folder / "again.world";
  start(3600.0, 3);
  EXPECT_TRUE(server->stop()) << "a server goes on with it";
}

TEST_F(LiveBackups, the_oldest_goes_when_there_are_more_than_are_kept) {
  start(1.0, 2);
  const BackupFolder backups(world, folder / "kept");
  std::ofstream(backups.path_at(1000)) << "an old one";
  ASSERT_TRUE(comes([&] { return list().size() == 2 && list().front().unix_s != 1000; }));
}

TEST_F(LiveBackups, a_folder_that_takes_nothing_is_told_in_health_and_log_until_it_does) {
  const CapturedLog log;
  start(1.0, 5);
  ASSERT_TRUE(comes([&] { return !list().empty(); }));
  EXPECT_FALSE(holds(health(), "backups"));
  fs::remove_all(folder / "kept");
  std::ofstream(folder / "kept") << "a file in its place";
  ASSERT_TRUE(comes([&] { return holds(health(), "\"name\":\"backups\""); })) << health();
  EXPECT_TRUE(holds(health(), "no backup has been made since"));
  EXPECT_FALSE(holds(health(), "kept")) << "health names no files";
  fs::remove(folder / "kept");
  ASSERT_TRUE(comes([&] { return !holds(health(), "backups"); })) << health();
  server.reset();
  EXPECT_EQ(log.count("no backup was made of"), 1U) << log.text();
  EXPECT_EQ(log.count("backups are made again"), 1U) << log.text();
}

}  // namespace
}  // namespace scree
