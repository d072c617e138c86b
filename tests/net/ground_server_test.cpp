// Clients without kernels on loopback: what they may ask of a server, and what ends their connection.
#include <gtest/gtest.h>

#include "server/net/net_server.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/raw_client.h"
#include "tests/support/tick_source.h"

namespace scree {
namespace {

using std::chrono::milliseconds;

class GroundServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    NetConfig config;
    config.terrain = flat_terrain;
    auto listening = NetServer::listen(config, commands, source.keyframe());
    ASSERT_TRUE(listening.has_value()) << listening.error().message;
    server = std::move(*listening);
  }
  std::unique_ptr<RawClient> join() {
    auto client = std::make_unique<RawClient>(server->port());
    HelloMessage hello{protocol_version, "test", {0.0F, 2.0F, 0.0F}, 64.0F};
    hello.lacks_kernels = true;
    EXPECT_TRUE(client->send(hello));
    EXPECT_TRUE(client->receive_as<WelcomeMessage>().has_value());
    return client;
  }
  void expect_refused(RawClient& client, const std::string& because) {
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal.has_value());
    EXPECT_NE(refusal->reason.find(because), std::string::npos) << refusal->reason;
  }
  /// Ticks until the client has the answer: the request may still be on its way.
  std::optional<GroundMessage> answer(RawClient& client) {
    for (int i = 0; i < 100; ++i) {
      server->publish(source.step());
      if (auto ground = client.receive_as<GroundMessage>(milliseconds(100))) return ground;
    }
    return std::nullopt;
  }

  CommandQueue commands{4};
  TickSource source{flat_terrain};
  std::unique_ptr<NetServer> server;
};

TEST_F(GroundServerTest, bricks_come_instead_of_operations_and_ground_on_request) {
  const auto client = join();
  server->publish(source.step({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 4)}));
  const auto frame = client->receive_as<FrameMessage>();
  ASSERT_TRUE(frame.has_value());
  EXPECT_TRUE(frame->operations.empty());
  EXPECT_FALSE(frame->patches.empty());
  ASSERT_TRUE(client->send(AskGroundMessage{{{0, -1, 0}, {100, 0, 0}}}));
  const auto near = answer(*client);
  ASSERT_TRUE(near.has_value());
  EXPECT_FALSE(near->beyond);
  EXPECT_NE(near->rock, 0U);
  const auto far = answer(*client);
  ASSERT_TRUE(far.has_value());
  EXPECT_TRUE(far->beyond);
}

TEST_F(GroundServerTest, more_ground_than_may_wait_ends_the_connection_and_is_counted) {
  const auto greedy = join();
  const auto modest = join();
  ASSERT_TRUE(greedy->send(AskGroundMessage{std::vector<ChunkCoord>(limits::ground_chunks_max)}));
  ASSERT_TRUE(greedy->send(AskGroundMessage{{{1, 2, 3}}}));
  expect_refused(*greedy, "limits.ground_chunks_max");
  ASSERT_TRUE(modest->send(AskGroundMessage{{{0, 0, 0}}}));
  EXPECT_TRUE(answer(*modest).has_value());
  EXPECT_EQ(server->stats().refusals.of(Refusal::ground_waiting), 1U);
}

TEST_F(GroundServerTest, a_request_of_too_many_chunks_or_of_one_beyond_all_worlds_is_refused) {
  for (const ChunkCoord bad : {ChunkCoord{1 << 24, 0, 0}, ChunkCoord{0, -(1 << 24), 0}}) {
    const auto client = join();
    ASSERT_TRUE(client->send(AskGroundMessage{{bad}}));
    expect_refused(*client, "chunk");
  }
  const auto client = join();
  ASSERT_TRUE(client->send(AskGroundMessage{std::vector<ChunkCoord>(limits::ground_chunks_max + 1)}));
  expect_refused(*client, "chunks of a ground request");
}

}  // namespace
}  // namespace scree
