// A network side that takes access tokens, on loopback, and clients of each role.
#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <string>

#include "auth/access_token.h"
#include "client/admin/admin.h"
#include "server/net/net_server.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/patience.h"
#include "tests/support/raw_client.h"
#include "tests/support/test_folder.h"

namespace scree {

inline constexpr const char* the_admin_token = "the-admin-token";

class AccessTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(key.write(folder / "key", folder / "key.pub"));
    config.terrain = flat_terrain;
    config.admin_token = the_admin_token;
    config.access.token_key_path = folder / "key.pub";
    config.access.anonymous = Role::viewer;
  }
  void start() {
    auto listening = NetServer::listen(config, commands, TickDelta());
    ASSERT_TRUE(listening) << listening.error().message;
    server = std::move(*listening);
  }
  std::string token(Role role, uint64_t id = 7, uint64_t expires_s = 0) const {
    return *sign({id, role, 0, expires_s, "", ""}, key);
  }
  static HelloMessage hello(const std::string& token) {
    return {protocol_version, "test", {0.0F, 2.0F, 0.0F}, 64.0F, "Ben", token};
  }
  /// A joined client, or null.
  std::unique_ptr<RawClient> join(const std::string& token, Role granted) {
    auto client = std::make_unique<RawClient>(server->port());
    EXPECT_TRUE(client->send(hello(token)));
    const auto welcome = client->receive_as<WelcomeMessage>();
    EXPECT_TRUE(welcome && welcome->role == granted);
    return client;
  }
  std::string refusal(const HelloMessage& hello) {
    RawClient client(server->port());
    EXPECT_TRUE(client.send(hello));
    const auto refused = client.receive_as<RefusalMessage>();
    return refused ? refused->reason : "";
  }
  AdminServer admin(const std::string& token) const {
    AdminServer admin;
    admin.port = server->port();
    admin.token = token;
    admin.within = patience;
    return admin;
  }
  uint64_t refusals(Refusal reason) const { return server->stats().refusals.of(reason); }
  /// Counts are published with ticks, and when sessions come and go.
  bool comes_to_refuse(Refusal reason) const {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (refusals(reason) == 0 && std::chrono::steady_clock::now() < end) wait_a_moment();
    return refusals(reason) > 0;
  }

  const TestFolder folder;
  const SigningKey key = SigningKey::generate();
  NetConfig config;
  CommandQueue commands{64};
  std::unique_ptr<NetServer> server;
};

}  // namespace scree
