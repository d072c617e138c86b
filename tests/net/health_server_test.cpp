// Health by the server's own port: without a place, a token or TLS, on a full server, by both languages.
#include <gtest/gtest.h>

#include "server/net/server_health.h"
#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"

namespace scree {
namespace {

class HealthServerTest : public NetServerTest {
 protected:
  std::optional<HealthMessage> ask() const {
    RawClient client(server->port());
    EXPECT_TRUE(client.send(AskHealthMessage{}));
    auto health = client.receive_as<HealthMessage>();
    EXPECT_TRUE(client.closed_within(seconds(10))) << "nothing more comes";
    return health;
  }
};

TEST_F(HealthServerTest, takes_no_place_and_no_token) {
  start([](NetConfig& config) {
    config.service.sessions_max = 1;
    config.admin_token = "the-admin-token";
  });
  const auto health = ask();
  ASSERT_TRUE(health);
  EXPECT_TRUE(health->alive && health->well);
  EXPECT_FALSE(health->ready) << "the witness has the only place";
  ASSERT_EQ(health->faults.size(), 1U);
  EXPECT_EQ(health->faults.front().name, "full");
  EXPECT_EQ(server->stats().sessions_joined, 1U);
  EXPECT_EQ(server->stats().refusals.total(), 0U) << "a probe is no refusal";
  expect_witness_unmoved();
  EXPECT_EQ(ask()->tick, source.tick());
}

TEST_F(HealthServerTest, says_what_the_host_found) {
  start([](NetConfig& config) {
    config.web.on = false;
    config.health = [] {
      ServerHealth found;
      found.add(HealthKind::saving, "the world cannot be saved");
      return found;
    };
  });
  const auto health = ask();
  ASSERT_TRUE(health);
  EXPECT_TRUE(health->alive && health->ready);
  EXPECT_FALSE(health->well);
  EXPECT_EQ(health->faults.front().words, "the world cannot be saved");
}

TEST_F(HealthServerTest, is_no_message_of_a_session) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  ASSERT_TRUE(client.receive_as<WelcomeMessage>());
  ASSERT_TRUE(client.send(AskHealthMessage{}));
  expect_refused(client, "a connection of its own");
}

TEST(ServerHealth, follows_from_what_was_found) {
  const auto of = [](HealthKind kind) {
    ServerHealth found;
    found.add(kind, "words");
    const HealthMessage health = found.as_of(7);
    return std::array{health.alive, health.well, health.ready};
  };
  EXPECT_EQ(of(HealthKind::simulation), (std::array{false, false, false}));
  EXPECT_EQ(of(HealthKind::saving), (std::array{true, false, true}));
  EXPECT_EQ(of(HealthKind::full), (std::array{true, true, false}));
  EXPECT_TRUE(ServerHealth().as_of(7).well);
  EXPECT_EQ(health_answer(ServerHealth().as_of(7)),
            "{\"alive\":true,\"well\":true,\"ready\":true,\"tick\":7,\"faults\":[]}\n");
}

}  // namespace
}  // namespace scree
