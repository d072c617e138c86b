// Bots that come back to a whole server: with what they kept in memory or in files, to the same world or to
// another one, and with files that others have damaged.
#include "client/cache/rejoin.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "client/bot/bot.h"
#include "client/cache/join_server.h"
#include "client/cache/limits.h"
#include "server/app/live_server.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

class RejoinTest : public ::testing::Test {
 protected:
  void SetUp() override { server_ = start(); }

  static LiveConfig live_config() {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.pacing = Pacing::by_hand;
    config.world.service.requests_per_second = 1000.0;
    return config;
  }
  static std::unique_ptr<LiveServer> start() {
    auto started = LiveServer::start(live_config());
    EXPECT_TRUE(started) << started.error().message;
    return started ? std::move(*started) : nullptr;
  }
  /// Comes, carves, and stays until all is at rest.
  BotConfig config(uint32_t carves) const {
    BotConfig bot;
    bot.port = server_->port();
    bot.carves = carves;
    bot.rate_hz = 0.0;
    bot.carver.area_m = 20.0F;
    bot.carver.radius_m = 1.0F;
    bot.carver.seeds = 3;
    bot.linger = true;
    bot.check_hash = true;
    bot.cache = {folder_ / "cache", size_t{1} << 24U};
    return bot;
  }
  template <typename F>
  bool go_on_until(Bot& bot, F&& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end || !server_->step_once()) return false;
      if (!bot.step(std::chrono::milliseconds(1))) return false;
    }
    return true;
  }
  /// The report of a bot that came, did what it was to do, and is gone.
  BotReport visit(const BotConfig& config) {
    Bot bot(config);
    EXPECT_TRUE(bot.join());
    EXPECT_TRUE(go_on_until(bot, [&] { return bot.finished(); }));
    EXPECT_TRUE(bot.report().hash.equal);
    EXPECT_EQ(bot.report().seen.mismatches, 0U);
    return bot.report();
  }
  std::filesystem::path file() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache"))
      if (entry.path().extension() == ".chunks") return entry.path();
    return {};
  }

  const TestFolder folder_;
  std::unique_ptr<LiveServer> server_;
};

TEST_F(RejoinTest, the_next_bot_gets_nothing_again_that_the_last_one_left_in_its_files) {
  const BotReport first = visit(config(8));
  EXPECT_EQ(first.seen.chunks_kept, 0U);
  const BotReport second = visit(config(0));
  EXPECT_EQ(second.seen.chunks, 0U);
  EXPECT_GT(second.seen.chunks_kept, 0U);
  EXPECT_EQ(second.chunks_held, first.chunks_held);
  EXPECT_LT(second.bytes.chunks, 16 * second.seen.chunks_kept + 64);
}

TEST_F(RejoinTest, what_others_carved_meanwhile_comes_whole) {
  visit(config(8));
  BotConfig other = config(3);
  other.cache = {};
  other.random_seed = 2;
  EXPECT_EQ(visit(other).seen.chunks_kept, 0U);
  const BotReport again = visit(config(0));
  EXPECT_GT(again.seen.chunks, 0U);
  EXPECT_GT(again.seen.chunks_kept, 0U);
}

TEST_F(RejoinTest, a_lost_connection_goes_on_as_the_same_session_with_what_the_mirror_held) {
  BotConfig in_memory = config(8);
  in_memory.cache.folder.clear();
  Bot bot(in_memory);
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.report().carves_accepted >= 4; }));
  const uint64_t session = bot.connection()->welcome().session;
  bot.connection()->abort();
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.finished(); }));
  EXPECT_EQ(bot.report().connections, 2U);
  EXPECT_EQ(bot.connection()->welcome().session, session);
  EXPECT_TRUE(bot.connection()->welcome().resumed);
  EXPECT_GT(bot.report().seen.chunks_kept, 0U);
  EXPECT_TRUE(bot.report().hash.equal);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cache"));
}

TEST_F(RejoinTest, another_world_at_the_same_address_is_not_mistaken_for_it) {
  // Another program of this machine may get the port in between; then all begins at a new one.
  bool at_same_port = false;
  for (int attempt = 0; attempt < 5 && !at_same_port; ++attempt) {
    visit(config(8));
    LiveConfig same = live_config();
    same.net.port = server_->port();
    server_.reset();
    auto restarted = LiveServer::start(same);
    at_same_port = restarted.has_value();
    server_ = restarted ? std::move(*restarted) : start();
    ASSERT_TRUE(server_);
  }
  ASSERT_TRUE(at_same_port);
  BotConfig elsewhere = config(4);
  elsewhere.random_seed = 3;
  EXPECT_EQ(visit(elsewhere).seen.chunks_kept, 0U);
  EXPECT_GT(visit(config(0)).seen.chunks_kept, 0U) << "of the new world";
}

TEST_F(RejoinTest, damaged_files_cost_bytes_and_nothing_else) {
  visit(config(8));
  for (int round = 0; round < 6; ++round) {
    std::vector<char> bytes;
    {
      std::ifstream in(file(), std::ios::binary);
      bytes.assign(std::istreambuf_iterator<char>(in), {});
    }
    const size_t at = bytes.size() * static_cast<size_t>(round) / 6;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    if (round % 2 == 1) bytes.resize(bytes.size() - 100);
    std::ofstream(file(), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    const BotReport report = visit(config(0));
    EXPECT_EQ(report.connections, 1U);
    EXPECT_GT(report.seen.chunks, 0U) << "what was damaged came whole";
  }
}

TEST_F(RejoinTest, while_a_session_lasts_its_chunks_are_packed_few_at_once_and_written) {
  BotConfig other = config(6);
  other.cache = {};
  visit(other);
  Rejoin rejoin(config(0).cache);
  ServerEndpoint endpoint;
  endpoint.port = server_->port();
  const auto connected =
      join_server(rejoin, endpoint, {protocol_version, "test", {}, 96.0F}, std::chrono::seconds(10));
  ASSERT_TRUE(connected) << connected.error().message;
  Connection& connection = **connected;
  const std::unique_ptr<Mirror> mirror = rejoin.begin(connection);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (mirror->field().hash() != server_->world()->field().hash() &&
         std::chrono::steady_clock::now() < end) {
    ASSERT_TRUE(server_->step_once());
    for (const Received& received : connection.wait(std::chrono::milliseconds(1)))
      ASSERT_TRUE(mirror->apply(received.message));
  }
  const size_t held = mirror->held_chunks().size();
  ASSERT_GT(held, 2 * limits::chunks_packed_at_once);
  double now_s = 1.0;
  rejoin.tend(now_s, *mirror, connection);
  now_s += limits::cache_interval_s;
  rejoin.tend(now_s, *mirror, connection);
  for (size_t packed = 0; packed < held; packed += limits::chunks_packed_at_once) {
    const size_t before = rejoin.cache().chunks();
    rejoin.tend(now_s, *mirror, connection);
    EXPECT_LE(rejoin.cache().chunks(), before + limits::chunks_packed_at_once);
  }
  EXPECT_EQ(rejoin.cache().chunks(), held);
  rejoin.tend(now_s + limits::cache_interval_s, *mirror, connection);
  rejoin.save();  // waits for the other thread
  const auto written = CacheFolder(folder_ / "cache", size_t{1} << 24U)
                           .read("127.0.0.1:" + std::to_string(server_->port()), std::nullopt);
  ASSERT_TRUE(written);
  EXPECT_EQ(written->world, connection.welcome().world);
  EXPECT_EQ(written->chunks.size(), held);
}

TEST_F(RejoinTest, two_at_once_leave_files_that_are_right) {
  visit(config(6));
  Bot one(config(3)), two(config(3));
  ASSERT_TRUE(one.join());
  ASSERT_TRUE(two.join());
  const auto both = [&] { return one.finished() && two.finished(); };
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!both() && std::chrono::steady_clock::now() < end) {
    ASSERT_TRUE(server_->step_once());
    ASSERT_TRUE(one.step(std::chrono::milliseconds(1)) && two.step(std::chrono::milliseconds(1)));
  }
  EXPECT_GT(one.report().seen.chunks_kept, 0U);
  EXPECT_GT(two.report().seen.chunks_kept, 0U);
  EXPECT_EQ(one.mirror()->field().hash(), two.mirror()->field().hash());
}

TEST_F(RejoinTest, who_went_away_and_comes_near_again_is_sent_nothing_twice) {
  BotConfig near = config(8);
  near.interest_radius_m = 40.0F;
  Bot bot(near);
  ASSERT_TRUE(bot.join());
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.finished(); }));
  const uint64_t whole = bot.report().seen.chunks;
  bot.set_interest({500.0F, 0.0F, 0.0F}, 40.0F);
  ASSERT_TRUE(go_on_until(bot, [&] { return bot.mirror()->held_chunks().empty(); }));
  bot.set_interest({0.0F, 0.0F, 0.0F}, 40.0F);
  ASSERT_TRUE(
      go_on_until(bot, [&] { return bot.mirror()->field().hash() == server_->world()->field().hash(); }));
  EXPECT_EQ(bot.report().seen.chunks, whole);
  EXPECT_GT(bot.report().seen.chunks_kept, 0U);
}

}  // namespace
}  // namespace scree
