// The spawn over the wire: every welcome has it, administrators set it by numbers or by a person's eye, and
// who has no place of their own follows the world around it.
#include <gtest/gtest.h>

#include "client/admin/admin.h"
#include "server/app/live_server.h"
#include "tests/support/flat_world.h"
#include "tests/support/holds.h"
#include "tests/support/raw_client.h"

namespace scree {
namespace {

const std::string spawn_token = "a-token-for-the-spawn";

class SpawnSession : public ::testing::Test {
 protected:
  void SetUp() override {
    LiveConfig config;
    config.world = flat_world();
    config.world.spawn = start;
    config.net.admin_token = spawn_token;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server = std::move(*started);
    admin.port = server->port();
    admin.token = spawn_token;
    admin.within = std::chrono::seconds(60);
  }
  std::optional<Spawn> welcomed() const {
    RawClient client(server->port());
    EXPECT_TRUE(client.send(HelloMessage{protocol_version, "test", {}, 8.0F}));
    const auto welcome = client.receive_as<WelcomeMessage>();
    return welcome ? welcome->spawn : std::nullopt;
  }
  std::string refusal(const std::string& place) const {
    const auto changed = change_settings(admin, {{"spawn", place}});
    return changed ? "" : changed.error().message;
  }

  const Spawn start{{3.0F, 2.0F, -4.0F}, 30.0F, -10.0F};
  std::unique_ptr<LiveServer> server;
  AdminServer admin;
};

TEST_F(SpawnSession, every_welcome_has_it_and_an_administrator_moves_it) {
  EXPECT_EQ(welcomed(), start);
  EXPECT_EQ(refusal("1,5,2,90,0"), "");
  EXPECT_EQ(welcomed(), (Spawn{{1.0F, 5.0F, 2.0F}, 90.0F, 0.0F}));
  EXPECT_TRUE(holds(refusal("1,5"), "spawn is auto or X,Y,Z"));
  EXPECT_EQ(refusal("0,-5,0"), "");
  const auto lifted = welcomed();
  ASSERT_TRUE(lifted.has_value());
  EXPECT_GT(lifted->eye_m.y, 0.5F) << "below is rock";
  EXPECT_EQ(refusal("auto"), "");
  EXPECT_NE(welcomed(), lifted);
}

TEST_F(SpawnSession, here_is_the_eye_of_the_person_who_is_there) {
  EXPECT_TRUE(holds(refusal("here"), "nobody is here from this address"));
  RawClient person(server->port());
  ASSERT_TRUE(person.send(HelloMessage{protocol_version, "test", {}, 8.0F}));
  const auto welcome = person.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome.has_value());
  ASSERT_TRUE(person.send(CursorMessage{{5.0F, 3.0F, 5.0F}, {5.0F, 3.0F, 0.0F}}));
  ASSERT_TRUE(person.send(PaintMessage{{sphere({0.0F, 0.0F, 0.0F}, 1.0F), material::soil}, 1}));
  ASSERT_TRUE(person.receive_as<ReplyMessage>().has_value()) << "the server has read as far as that";
  EXPECT_EQ(refusal("here"), "");
  const Spawn there{{5.0F, 3.0F, 5.0F}, 0.0F, 0.0F};
  EXPECT_EQ(welcomed(), there);
  EXPECT_TRUE(holds(refusal("here 999"), "session 999 has no eye"));
  ASSERT_TRUE(person.send(CursorMessage{{7.0F, 3.0F, 5.0F}, {0.0F, 3.0F, 5.0F}}));
  ASSERT_TRUE(person.send(PaintMessage{{sphere({0.0F, 0.0F, 0.0F}, 1.0F), material::rock}, 2}));
  ASSERT_TRUE(person.receive_as<ReplyMessage>().has_value());
  EXPECT_EQ(refusal("here " + std::to_string(welcome->session)), "");
  EXPECT_EQ(welcomed(), (Spawn{{7.0F, 3.0F, 5.0F}, 90.0F, 0.0F}));
}

TEST_F(SpawnSession, who_has_no_place_follows_the_world_around_it) {
  RawClient builder(server->port());
  ASSERT_TRUE(builder.send(HelloMessage{protocol_version, "test", {}, 8.0F}));
  ASSERT_TRUE(builder.send(PaintMessage{{sphere({3.0F, 0.0F, -4.0F}, 1.0F), material::soil}, 1}));
  ASSERT_TRUE(builder.receive_as<ReplyMessage>().has_value());
  HelloMessage hello{protocol_version, "test", {900.0F, 0.0F, 0.0F}, 8.0F};
  hello.at_spawn = true;
  RawClient newcomer(server->port());
  ASSERT_TRUE(newcomer.send(hello));
  EXPECT_TRUE(newcomer.receive_as<ChunkMessage>().has_value());
}

}  // namespace
}  // namespace scree
