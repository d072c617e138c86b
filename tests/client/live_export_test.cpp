// Exports of a running server: the same terrain as the server has, within a box and of all; and what cannot
// be fetched, in words.
#include <future>
#include <gtest/gtest.h>

#include "client/bot/bot.h"
#include "server/app/live_server.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_ground.h"
#include "tools/export/live/live_terrain.h"

namespace scree {
namespace {

class LiveExportTest : public ::testing::Test {
 protected:
  void serve(const TerrainSource& terrain) {
    LiveConfig config;
    config.world.terrain = terrain;
    config.pacing = Pacing::by_hand;
    config.world.service.requests_per_second = 1000.0;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server_ = std::move(*started);
  }
  /// Ticks while `work` lasts, which has a thread of its own: the world belongs to this one.
  template <typename Work>
  auto while_it_ticks(const Work& work) {
    auto done = std::async(std::launch::async, work);
    while (done.wait_for(std::chrono::milliseconds(0)) != std::future_status::ready) server_->step_once();
    return done.get();
  }
  void carve(float x_m) {
    BotConfig config;
    config.port = server_->port();
    config.carves = 4;
    config.rate_hz = 0.0;
    config.carver.centre_m = {x_m, 0.0F, 0.0F};
    config.carver.area_m = 6.0F;
    config.carver.radius_m = 1.5F;
    config.carver.seeds = 3;
    config.interest_radius_m = 40.0F;
    config.linger = true;
    Bot bot(config);
    const BotReport report = while_it_ticks([&] { return bot.run(); });
    ASSERT_EQ(report.failure, "");
    ASSERT_GT(report.carves_accepted, 0U);
  }
  Result<LiveTerrain> fetch(const LiveFetch& how) {
    return while_it_ticks([&] { return fetch_terrain(how, [](double) {}); });
  }
  LiveFetch all() const { return {.server = {.port = server_->port()}, .within = patience}; }
  LiveFetch within(glm::vec3 lo_m, glm::vec3 hi_m) const {
    LiveFetch how = all();
    how.box = [=](const Field& field) { return chunks_of(lo_m, hi_m, field.source().voxel_size_m); };
    return how;
  }
  void expect_same(const LiveTerrain& terrain) {
    const Field& there = server_->world()->field();
    for_each_chunk(terrain.box.voxels(), [&](ChunkCoord chunk) {
      ASSERT_EQ(terrain.field->chunk_hash(chunk), there.chunk_hash(chunk));
      for (int i = 0; i < 64; ++i) {
        const BrickCoord brick = brick_in_chunk(chunk, i);
        ASSERT_EQ(terrain.field->brick(brick), there.brick(brick));
      }
    });
  }

  TestFolder folder_;
  std::unique_ptr<LiveServer> server_;
};

TEST_F(LiveExportTest, all_edits_are_fetched_and_far_ones_only_in_their_box) {
  serve({TerrainKind::flat, 1, 0.25F});
  const auto none = fetch(all());
  ASSERT_FALSE(none);
  EXPECT_TRUE(holds(none.error().message, "--box")) << none.error().message;
  carve(0.0F);
  const auto near = fetch(all());
  ASSERT_TRUE(near) << near.error().message;
  EXPECT_EQ(near->field->hash(), server_->world()->field().hash());
  expect_same(*near);
  carve(400.0F);
  const auto beyond = fetch(all());
  ASSERT_FALSE(beyond);
  EXPECT_TRUE(holds(beyond.error().message, "edits lie farther than 256 m")) << beyond.error().message;
  const auto far = fetch(within({385.0F, -8.0F, -15.0F}, {415.0F, 8.0F, 15.0F}));
  ASSERT_TRUE(far) << far.error().message;
  EXPECT_GT(far->field->edited_chunks().size(), 0U);
  expect_same(*far);
  const auto both = fetch(within({-8.0F, -8.0F, -8.0F}, {408.0F, 8.0F, 8.0F}));
  ASSERT_TRUE(both) << both.error().message;
  EXPECT_GT(both->sessions, 2U) << "in parts";
  expect_same(*both);
}

TEST_F(LiveExportTest, a_ground_of_tiles_comes_with_the_edits_and_needs_no_server_then) {
  serve({.heights = written_ground(folder_ / "hills.ground", 60, 40, 2.0F)});
  carve(0.0F);
  const auto whole = fetch(all());
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->field->hash(), server_->world()->field().hash());
  const auto part = fetch(within({-20.0F, 0.0F, -20.0F}, {20.0F, 40.0F, 20.0F}));
  ASSERT_TRUE(part) << part.error().message;
  expect_same(*part);
}

TEST_F(LiveExportTest, a_server_that_stands_still_or_is_not_there_is_named) {
  serve({TerrainKind::flat, 1, 0.25F});
  LiveFetch how = all();
  how.within = std::chrono::seconds(1);
  const auto still = fetch_terrain(how, [](double) {});
  ASSERT_FALSE(still);
  EXPECT_TRUE(holds(still.error().message, "not complete within 1 s")) << still.error().message;
  server_.reset();
  const auto gone = fetch_terrain(how, [](double) {});
  ASSERT_FALSE(gone);
  EXPECT_TRUE(holds(gone.error().message, "127.0.0.1:")) << gone.error().message;
}

}  // namespace
}  // namespace scree
