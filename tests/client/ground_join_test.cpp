// Clients on a ground by heights: its tiles come once, are kept, and are checked; what is carved is the same
// on both sides.
#include <gtest/gtest.h>

#include "client/bot/bot.h"
#include "client/cache/limits.h"
#include "client/cache/received_tiles.h"
#include "crypto/sha256.h"
#include "server/app/live_server.h"
#include "tests/support/box_solid.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_ground.h"

namespace scree {
namespace {

class GroundJoinTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ground_ = written_ground(folder_ / "hills.ground", 700, 300, 1.0F);
    serve();
  }
  void serve() {
    LiveConfig config;
    config.world.terrain.heights = ground_;
    config.pacing = Pacing::by_hand;
    config.world.service.requests_per_second = 1000.0;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server_ = std::move(*started);
  }
  BotConfig config(uint32_t carves, size_t cache_bytes) const {
    BotConfig bot;
    bot.port = server_->port();
    bot.carves = carves;
    bot.rate_hz = 0.0;
    bot.carver.area_m = 20.0F;
    bot.carver.radius_m = 1.0F;
    bot.carver.seeds = 3;
    bot.interest_radius_m = 64.0F;
    bot.linger = true;
    bot.check_hash = true;
    bot.cache = {folder_ / "cache", cache_bytes};
    return bot;
  }
  bool go_on_until(Bot& bot, const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end || !server_->step_once()) return false;
      if (!bot.step(std::chrono::milliseconds(1))) return false;
    }
    return true;
  }
  BotReport visit(const BotConfig& config) {
    Bot bot(config);
    EXPECT_TRUE(bot.join());
    EXPECT_TRUE(go_on_until(bot, [&] { return bot.finished(); })) << bot.report().failure;
    EXPECT_TRUE(bot.report().hash.equal);
    EXPECT_EQ(bot.report().seen.mismatches, 0U);
    return bot.report();
  }

  TestFolder folder_;
  std::shared_ptr<const GroundFile> ground_;
  std::unique_ptr<LiveServer> server_;
};

TEST_F(GroundJoinTest, what_is_carved_is_the_same_and_tiles_come_once) {
  const BotReport first = visit(config(6, size_t{1} << 24U));
  EXPECT_GT(first.bytes.tiles, 0U);
  EXPECT_GT(first.seen.operations.of<CarveOperation>(), 0U) << "operations come, not bricks";
  EXPECT_GT(first.seen.pieces_made, 0U);
  const BotReport second = visit(config(3, size_t{1} << 24U));
  EXPECT_EQ(second.bytes.tiles, 0U) << "all of it was kept";
  EXPECT_GT(second.seen.operations.of<CarveOperation>(), 0U);
  const BotReport other = visit(config(0, 0));
  EXPECT_EQ(other.bytes.tiles, first.bytes.tiles) << "who keeps nothing is sent all again";
}

TEST_F(GroundJoinTest, near_ground_is_complete_and_bit_for_bit_the_servers) {
  Bot bot(config(1, 0));
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.finished(); }));
  const TerrainSource& there = server_->world()->config().terrain;
  const TerrainSource& here = bot.mirror()->terrain();
  for (int x = -6; x < 6; ++x)
    for (int z = -6; z < 6; ++z)
      for (int y = -1; y < 4; ++y) {
        const ChunkCoord chunk{x, y, z};
        ASSERT_TRUE(is_here(here, chunk));
        const GeneratedChunk ours = generate_chunk(here, chunk), theirs = generate_chunk(there, chunk);
        EXPECT_TRUE(ours.exact && theirs.exact);
        for (size_t i = 0; i < ours.bricks.size(); ++i) EXPECT_EQ(*ours.bricks[i], *theirs.bricks[i]);
      }
}

TEST_F(GroundJoinTest, files_of_tiles_that_were_damaged_are_sent_again) {
  const BotReport first = visit(config(0, size_t{1} << 24U));
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache"))
    if (entry.path().extension() == tile_extension) std::filesystem::resize_file(entry.path(), 100);
  EXPECT_EQ(visit(config(0, size_t{1} << 24U)).bytes.tiles, first.bytes.tiles);
}

TEST_F(GroundJoinTest, tiles_nobody_asked_for_and_tiles_of_another_hash_are_refused) {
  const HeightLayout& layout = ground_->layout();
  ReceivedTiles tiles({layout, ground_->header().ground.top}, TileFolder({}));
  EXPECT_FALSE(tiles.accept({layout.top(), ground_->packed(layout.top())})) << "not asked for";
  EXPECT_EQ(tiles.next_request({}, 64.0F).wanted, std::vector<TileKey>{layout.top()})
      << "it names the others";
  std::vector<uint8_t> wrong = ground_->packed(layout.top());
  wrong.back() ^= 1U;
  EXPECT_FALSE(tiles.accept({layout.top(), wrong}));
  ReceivedTiles good({layout, ground_->header().ground.top}, TileFolder({}));
  for (AskTilesMessage request = good.next_request({}, 64.0F); !request.wanted.empty();
       request = good.next_request({}, 64.0F))
    for (const TileKey key : request.wanted) ASSERT_TRUE(good.accept({key, ground_->packed(key)}));
  EXPECT_TRUE(good.has_near({}, 64.0F));
  EXPECT_EQ(good.tile({0, 0, 0}), nullptr) << "nobody has missed it";
  EXPECT_EQ(good.next_request({}, 64.0F).wanted, (std::vector<TileKey>{{1, 0, 0}})) << "which names it";
  ASSERT_TRUE(good.accept({{1, 0, 0}, ground_->packed({1, 0, 0})}));
  EXPECT_EQ(good.next_request({}, 64.0F).wanted, (std::vector<TileKey>{{0, 0, 0}}));
  good.begin_session();
  EXPECT_EQ(good.next_request({}, 64.0F).held.size(), good.tiles_received());
}

TEST_F(GroundJoinTest, coarse_tiles_are_asked_for_before_fine_ones) {
  const HeightLayout& layout = ground_->layout();
  ReceivedTiles tiles({layout, ground_->header().ground.top}, TileFolder({}));
  bool mixed = false;
  const auto next = [&] { return tiles.next_request({}, 64.0F).wanted; };
  for (std::vector<TileKey> wanted = next(); !wanted.empty(); wanted = next()) {
    EXPECT_TRUE(std::ranges::is_sorted(wanted, std::ranges::greater{}, &TileKey::level));
    mixed = mixed || wanted.front().level != wanted.back().level;
    for (const TileKey key : wanted) ASSERT_TRUE(tiles.accept({key, ground_->packed(key)}));
    if (wanted.front().level == 1) tiles.tile({0, 0, 0});  // somebody misses a far one
  }
  EXPECT_TRUE(mixed);
}

/// The same with stored bricks over the hills.
class BrickJoinTest : public GroundJoinTest {
 protected:
  void SetUp() override {
    GroundJoinTest::SetUp();
    ground_ = written_table(folder_ / "table.ground", ground_);
    serve();
  }
};

TEST_F(BrickJoinTest, stored_chunks_come_once_and_are_bit_for_bit_the_servers) {
  Bot bot(config(6, size_t{1} << 24U));
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.finished(); })) << bot.report().failure;
  EXPECT_TRUE(bot.report().hash.equal);
  EXPECT_EQ(bot.report().seen.mismatches, 0U);
  EXPECT_GT(bot.report().seen.pieces_made, 0U);
  const TerrainSource& here = bot.mirror()->terrain();
  size_t stored = 0;
  for (const TileKey key : ground_->chunks()) {
    if (key.level != 0) continue;
    const ChunkCoord chunk = chunk_of(key);
    ASSERT_TRUE(is_here(here, chunk));
    EXPECT_TRUE(
        same_bricks(generate_chunk(here, chunk), generate_chunk(server_->world()->config().terrain, chunk)));
    ++stored;
  }
  EXPECT_GT(stored, 8U);
  EXPECT_EQ(visit(config(2, size_t{1} << 24U)).bytes.tiles, 0U) << "all of it was kept";
}

TEST_F(BrickJoinTest, a_stored_chunk_of_another_hash_is_refused_and_the_next_coarser_names_it) {
  ReceivedTiles tiles(ground_->header().ground, TileFolder({}));
  const TileKey root = ground_->bricks()->root();
  size_t taken = 0;
  for (AskTilesMessage request = tiles.next_request({}, 64.0F); !request.wanted.empty();
       request = tiles.next_request({}, 64.0F))
    for (const TileKey key : request.wanted) {
      EXPECT_TRUE(taken > 0 || key == root || key.kind == TileKind::heights);
      ASSERT_TRUE(tiles.accept({key, ground_->packed(key)}));
      EXPECT_FALSE(tiles.accept({key, ground_->packed(key)})) << "it came already";
      ++taken;
    }
  EXPECT_TRUE(tiles.has_near({}, 64.0F));
  ReceivedTiles other(ground_->header().ground, TileFolder({}));
  ASSERT_FALSE(other.next_request({}, 64.0F).wanted.empty());
  std::vector<uint8_t> wrong = ground_->packed(root);
  wrong.back() ^= 1U;
  EXPECT_FALSE(other.accept({root, wrong}));
}

}  // namespace
}  // namespace scree
