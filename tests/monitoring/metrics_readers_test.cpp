// Who may read /metrics: programs of this machine, of networks that are listed, and administrators.
#include <gtest/gtest.h>

#include "crypto/signing_key.h"
#include "tests/monitoring/worked_server.h"
#include "tests/support/certificates.h"

namespace scree {
namespace {

class MetricsReaders : public ::testing::Test {
 protected:
  HttpClient open(const std::function<void(NetConfig&)>& change = {}) {
    LiveConfig config;
    config.pacing = Pacing::by_hand;
    config.world.terrain = flat_terrain;
    if (change) change(config.net);
    server = *LiveServer::start(config);
    server->step_once();
    return HttpClient(server->port());
  }
  static std::function<void(NetConfig&)> readers(const std::vector<std::string>& networks,
                                                 const std::vector<std::string>& proxies = {}) {
    return [networks, proxies](NetConfig& net) {
      net.metrics_readers = *read_networks(networks);
      net.proxies = *Proxies::parse(proxies);
      net.web.hosts = {"play.example.org"};  // strangers come by: this machine has no more rights than they
    };
  }
  std::unique_ptr<LiveServer> server;
};

TEST_F(MetricsReaders, are_programs_of_this_machine_also_where_there_are_administrators) {
  EXPECT_EQ(open().get("/metrics").status, 200);
  EXPECT_EQ(open([](NetConfig& net) { net.admin_token = "the-admin-token"; }).get("/metrics").status, 200);
}

TEST_F(MetricsReaders, are_nobody_by_a_name_that_leads_here_or_through_a_proxy) {
  EXPECT_EQ(open().ask_for("rebound.example").get("/metrics").status, 403);
  EXPECT_EQ(open().get("/metrics", "X-Forwarded-For: 192.0.2.7\r\n").status, 403);
  EXPECT_EQ(open().get("/metrics", "Origin: http://elsewhere.example\r\n").status, 403);
}

TEST_F(MetricsReaders, are_nobody_without_a_token_where_strangers_come_by) {
  EXPECT_EQ(open(readers({})).get("/metrics").status, 403);
  EXPECT_EQ(open([](NetConfig& net) { net.proxies = *Proxies::parse({"192.0.2.1"}); }).get("/metrics").status,
            403);
}

TEST_F(MetricsReaders, are_programs_of_networks_that_are_listed) {
  EXPECT_EQ(open(readers({"127.0.0.0/8"})).get("/metrics").status, 200);
  EXPECT_EQ(open(readers({"192.0.2.0/24", "127.0.0.1"})).get("/metrics").status, 200);
  EXPECT_EQ(open(readers({"192.0.2.0/24"})).get("/metrics").status, 403);
  EXPECT_EQ(open(readers({"::/0"})).get("/metrics").status, 403) << "a network of IPv6 holds no IPv4 address";
}

TEST_F(MetricsReaders, of_a_network_may_name_the_server_as_they_reach_it) {
  EXPECT_EQ(open(readers({"127.0.0.1"})).ask_for("server:4177").get("/metrics").status, 200);
}

TEST_F(MetricsReaders, of_a_network_are_not_those_who_come_by_its_proxy) {
  const std::string stranger = "X-Forwarded-For: 203.0.113.9\r\n";
  EXPECT_EQ(open(readers({"127.0.0.1"})).get("/metrics", stranger).status, 403)
      << "a proxy that nobody trusts";
  EXPECT_EQ(open(readers({"127.0.0.1"}, {"127.0.0.1"})).get("/metrics", stranger).status, 403)
      << "a trusted one speaks for somebody else";
  EXPECT_EQ(open(readers({"203.0.113.0/24"}, {"127.0.0.1"})).get("/metrics", stranger).status, 200)
      << "and here for a reader";
}

TEST_F(MetricsReaders, are_administrators_by_their_token) {
  const auto with_administrators = [](NetConfig& net) {
    readers({})(net);
    net.admin_token = "the-admin-token";
  };
  const auto with = [&](const std::string& token) {
    return open(with_administrators)
        .get("/metrics", token.empty() ? "" : "Authorization: Bearer " + token + "\r\n");
  };
  EXPECT_EQ(with("").status, 401);
  EXPECT_EQ(with("").field("WWW-Authenticate"), "Bearer");
  EXPECT_EQ(with("the-admin-token").status, 200);
  EXPECT_EQ(with("a-wrong-token").status, 403);
}

TEST_F(MetricsReaders, are_holders_of_an_access_token_of_the_role_admin_alone) {
  const TestFolder folder;
  const SigningKey key = SigningKey::generate();
  ASSERT_TRUE(key.write(folder / "key", folder / "key.pub"));
  HttpClient client = open([&](NetConfig& net) {
    readers({})(net);
    net.access.token_key_path = folder / "key.pub";
  });
  const auto with = [&](Role role) {
    const std::string token = *sign({7, role, 0, 0, "", ""}, key);
    return client.get("/metrics", "Authorization: Bearer " + token + "\r\n").status;
  };
  EXPECT_EQ(with(Role::admin), 200);
  EXPECT_EQ(with(Role::director), 403);
}

TEST_F(MetricsReaders, get_nothing_by_other_methods_than_get_and_head) {
  HttpClient client = open();
  EXPECT_EQ(client.get("/metrics", "", "HEAD").status, 200);
  EXPECT_NE(client.get("/metrics", "Content-Length: 0\r\n", "POST").status, 200);
}

TEST_F(MetricsReaders, are_those_of_a_server_with_http) {
  HttpClient client = open([](NetConfig& net) { net.web.on = false; });
  EXPECT_EQ(client.get("/metrics").status, 0);
}

}  // namespace
}  // namespace scree
