// A saved world is new when no file of it was there, before it starts and after. It starts once.
#include "server/app/saved_world.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

class SavedWorldTest : public ::testing::Test {
 protected:
  std::unique_ptr<SavedWorld> open() {
    WorldConfig config;
    config.terrain = flat_terrain;
    auto opened = SavedWorld::open(folder / "world", config, 1, {});
    EXPECT_TRUE(opened.has_value()) << opened.error().message;
    return std::move(*opened);
  }
  static SaverConfig saving() {
    return {.durability = Durability::off, .autosave_s = 0.0, .before_save = {}};
  }

  const TestFolder folder;
};

TEST_F(SavedWorldTest, a_world_is_new_when_no_file_of_it_was_there_also_after_it_started) {
  {
    const auto kept = open();
    EXPECT_TRUE(kept->is_new());
    const auto world = kept->release_world();
    ASSERT_TRUE(kept->start(*world, saving()).has_value());
    EXPECT_TRUE(kept->is_new());
    kept->note(*world->step({}), *world);
    ASSERT_TRUE(kept->finish(*world).has_value());
  }
  const auto kept = open();
  EXPECT_FALSE(kept->is_new());
  const auto world = kept->release_world();
  EXPECT_EQ(world->tick(), 1U);
  ASSERT_TRUE(kept->start(*world, saving()).has_value());
  EXPECT_FALSE(kept->is_new());
}

TEST_F(SavedWorldTest, starts_once) {
  const auto kept = open();
  const auto world = kept->release_world();
  ASSERT_TRUE(kept->start(*world, saving()).has_value());
  EXPECT_DEATH(static_cast<void>(kept->start(*world, saving())), "a saved world starts once");
}

TEST_F(SavedWorldTest, says_what_it_saved_also_when_it_was_abandoned) {
  const auto kept = open();
  const auto world = kept->release_world();
  ASSERT_TRUE(kept->start(*world, saving()).has_value());
  kept->note(*world->step({}), *world);
  kept->abandon();
  EXPECT_EQ(kept->status().saved_tick, 0U);
  EXPECT_TRUE(kept->status().health.ok());
}

TEST_F(SavedWorldTest, a_file_that_is_no_whole_world_is_refused_with_the_way_out) {
  const std::string path = folder / "world";
  {
    const auto kept = open();
    const auto world = kept->release_world();
    ASSERT_TRUE(kept->start(*world, saving()).has_value());
    ASSERT_TRUE(kept->finish(*world).has_value());
  }
  WorldConfig config;
  config.terrain = flat_terrain;
  const auto refusal = [&] {
    const auto opened = SavedWorld::open(path, config, 1, {});
    return opened ? std::string() : opened.error().message;
  };
  const auto whole = std::filesystem::file_size(path);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(4096);  // the second page
    file << std::string(2048, 'x');
  }
  EXPECT_TRUE(holds(refusal(), "scree world repair " + path)) << refusal();
  EXPECT_TRUE(holds(refusal(), "Start with a backup")) << refusal();
  std::filesystem::resize_file(path, whole - 1000);
  EXPECT_TRUE(holds(refusal(), "are no whole pages. Start with a backup")) << refusal();
  std::filesystem::resize_file(path, 0);
  EXPECT_TRUE(holds(refusal(), "it has only 0 bytes. Put a backup in its place")) << refusal();
  EXPECT_FALSE(holds(refusal(), "repair")) << "there is nothing to repair";
  std::filesystem::remove(path);
  std::ofstream(path) << "A letter to somebody, which is long enough.";
  EXPECT_FALSE(holds(refusal(), "backup")) << "it was never a world";
}

}  // namespace
}  // namespace scree
