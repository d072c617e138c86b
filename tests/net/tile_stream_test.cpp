// Tiles on request: each once, within a budget; and who lacks them gets bricks instead of operations.
#include <gtest/gtest.h>

#include "tests/support/publisher_fixture.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_ground.h"

namespace scree {
namespace {

class TileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ground_ = written_ground(folder_ / "a.ground", 300, 300, 1.0F);
    view_ = std::make_unique<ClientView>(glm::vec3(0.0F), 64.0F, true);
    stream_ = std::make_unique<TileStream>(ground_);
  }
  std::vector<TileKey> all() const {
    std::vector<TileKey> keys;
    for (int level = 0; level < ground_->layout().levels(); ++level)
      for (int z = 0; z < HeightLayout::tiles_on(level, 300); ++z)
        for (int x = 0; x < HeightLayout::tiles_on(level, 300); ++x) keys.push_back({level, x, z});
    return keys;
  }
  std::vector<SharedBytes> serve() {
    std::vector<SharedBytes> sent;
    stream_->serve([&](uint64_t) { return reads_ ? view_.get() : nullptr; },
                   [&](uint64_t, const SharedBytes& bytes) {
                     sent.push_back(bytes);
                     return true;
                   });
    return sent;
  }

  TestFolder folder_;
  std::shared_ptr<const GroundFile> ground_;
  std::unique_ptr<ClientView> view_;
  std::unique_ptr<TileStream> stream_;
  bool reads_ = true;
};

TEST_F(TileTest, each_tile_is_sent_once_and_what_is_held_never) {
  ASSERT_TRUE(stream_->ask(1, 1, {all(), {{0, 1, 1}}}, *view_));
  ASSERT_TRUE(stream_->ask(1, 1, {all(), {}}, *view_));
  size_t sent = 0;
  for (int tick = 0; tick < 100; ++tick) sent += serve().size();
  EXPECT_EQ(sent, all().size() - 1);
  EXPECT_EQ(stream_->waiting(1), 0U);
  for (const TileKey key : all()) EXPECT_TRUE(view_->holds_tile(key));
}

TEST_F(TileTest, a_tick_sends_no_more_than_its_bytes_and_one_tile) {
  ASSERT_TRUE(stream_->ask(1, 1, {all(), {}}, *view_));
  int64_t bytes = 0;
  for (int tick = 1; stream_->waiting(1) > 0; ++tick) {
    for (const SharedBytes& each : serve()) bytes += static_cast<int64_t>(each->size());
    EXPECT_LE(bytes, tick * limits::tile_bytes_per_tick + static_cast<int64_t>(limits::tile_bytes_max));
  }
}

TEST_F(TileTest, requests_are_bounded_and_keys_of_no_tile_are_skipped) {
  EXPECT_FALSE(stream_->ask(1, 1, {std::vector<TileKey>(limits::tiles_wanted_max + 1), {}}, *view_));
  ASSERT_TRUE(stream_->ask(1, 1, {{{9, 0, 0}, {0, 3, 0}, {0, -1, 0}, {-1, 0, 0}}, {{7, 7, 7}}}, *view_));
  EXPECT_EQ(stream_->waiting(1), 0U);
  EXPECT_FALSE(view_->holds_tile({7, 7, 7}));
  reads_ = false;
  ASSERT_TRUE(stream_->ask(1, 1, {std::vector<TileKey>(limits::tiles_wanted_max), {}}, *view_));
  EXPECT_TRUE(serve().empty());
  EXPECT_FALSE(stream_->ask(1, 1, {{{0, 0, 0}}, {}}, *view_));
  stream_->leave(1);
  EXPECT_EQ(stream_->waiting(1), 0U);
  TileStream none(nullptr);
  EXPECT_TRUE(none.ask(1, 1, {{{0, 0, 0}}, {}}, *view_)) << "a ground without tiles";
  EXPECT_EQ(none.waiting(1), 0U);
}

}  // namespace
}  // namespace scree
