// status.json: who is told how the server does.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/app/live_server.h"
#include "tests/support/certificates.h"
#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/web_client.h"
#include "tests/support/web_folder.h"

namespace scree {
namespace {

class WebStatusTest : public ::testing::Test {
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
  std::unique_ptr<LiveServer> server;
};

TEST_F(WebStatusTest, tells_this_machine_of_an_open_server) {
  open();
  WebSocketClient person(server->port());
  ASSERT_TRUE(person.send(hello()));
  ASSERT_TRUE(person.receive_as<WelcomeMessage>());
  server->step_once();
  HttpClient client(server->port());
  const HttpAnswer answer = client.get("/status.json");
  ASSERT_EQ(answer.status, 200);
  EXPECT_EQ(answer.field("Content-Type"), "application/json");
  EXPECT_EQ(answer.field("Cache-Control"), "no-store");
  const auto json = nlohmann::json::parse(answer.body);
  EXPECT_EQ(json["now"]["tick"], 2);
  EXPECT_EQ(json["now"]["stages_ms"].size(), tick_stages.size());
  EXPECT_EQ(json["now"]["latency_ms"].size(), latency_stages.size());
  EXPECT_EQ(json["health"]["well"], true);
  EXPECT_EQ(json["health"]["faults"].size(), 0U);
  EXPECT_EQ(json["sessions"].size(), 1U);
  EXPECT_EQ(json["sessions"][0]["program"], "test");
  EXPECT_EQ(json["sessions"][0]["role"], "builder");
  EXPECT_EQ(json["sessions"][0]["address"], "") << "who asks without a token may be anybody behind a proxy";
  EXPECT_EQ(json["sessions"][0]["name"], "");
  EXPECT_EQ(json["report"]["ledger"]["error"], 0);
  EXPECT_EQ(json["report"]["sessions"]["now"], 1);
  EXPECT_EQ(json["report"]["web"]["websockets"], 1);
  EXPECT_EQ(json["tick_rate_hz"], 60);
  EXPECT_EQ(json["replay"], false);
  EXPECT_TRUE(json["report"]["refusals"].contains("by_reason"));
}

TEST_F(WebStatusTest, tells_nobody_by_a_name_that_leads_here) {
  HttpClient client = open();
  EXPECT_EQ(client.ask_for("rebound.example").get("/status.json").status, 421);
}

TEST_F(WebStatusTest, tells_nobody_through_a_proxy_on_this_machine) {
  HttpClient client = open();
  EXPECT_EQ(client.get("/status.json", "X-Forwarded-For: 192.0.2.7\r\n").status, 403);
  EXPECT_EQ(client.get("/status.json").status, 403) << "it is the proxy's connection still";
  EXPECT_EQ(HttpClient(server->port()).get("/status.json").status, 200) << "but its own programs";
}

TEST_F(WebStatusTest, tells_nobody_without_a_token_where_strangers_come_by) {
  open([](NetConfig& net) { net.proxies = *Proxies::parse({"192.0.2.1"}); });
  EXPECT_EQ(HttpClient(server->port()).get("/status.json").status, 403) << "a proxy is named";
  open([](NetConfig& net) { net.web.hosts = {"play.example.org"}; });
  EXPECT_EQ(HttpClient(server->port()).get("/status.json").status, 403) << "a public name is named";
  HttpClient other_host = open();
  EXPECT_EQ(other_host.ask_for("192.168.0.7:4177").get("/status.json").status, 403)
      << "a program here would not come from loopback";
  EXPECT_EQ(HttpClient(server->port()).get("/status.json").status, 200);
}

TEST_F(WebStatusTest, tells_administrators_alone_where_there_are_any) {
  HttpClient client = open([](NetConfig& net) { net.admin_token = "the-admin-token"; });
  const auto with = [&](const std::string& token) {
    return client.get("/status.json", token.empty() ? "" : "Authorization: Bearer " + token + "\r\n");
  };
  EXPECT_EQ(with("").status, 401);
  EXPECT_EQ(with("").field("WWW-Authenticate"), "Bearer");
  EXPECT_EQ(with("").body, "token_missing\n");
  EXPECT_EQ(with("the-admin-token").status, 200);
  EXPECT_EQ(with("a-wrong-token").status, 403);
  EXPECT_EQ(with("a-wrong-token").status, 403) << "the same one again costs nothing";
  EXPECT_EQ(with("the-admin-token").status, 429) << "after a wrong one everybody there waits";
  EXPECT_EQ(client.get("/status.json?token=the-admin-token").status, 401) << "addresses are written down";
  EXPECT_EQ(client.get("/healthz").status, 200);
}

TEST_F(WebStatusTest, tells_holders_of_an_administrators_access_token) {
  const TestFolder folder;
  const SigningKey key = SigningKey::generate();
  ASSERT_TRUE(key.write(folder / "key", folder / "key.pub"));
  HttpClient client = open([&](NetConfig& net) { net.access.token_key_path = folder / "key.pub"; });
  const auto with = [&](Role role) {
    const std::string token = *sign({7, role, 0, 0, "", ""}, key);
    return client.get("/status.json", "Authorization: Bearer " + token + "\r\n").status;
  };
  EXPECT_EQ(with(Role::admin), 200);
  EXPECT_EQ(with(Role::builder), 403);
  EXPECT_EQ(client.get("/status.json", "Authorization: Bearer nonsense\r\n").status, 403);
}

}  // namespace
}  // namespace scree
