// Pages of other sites whose names were made to lead to the server (DNS rebinding), and names that lead there
// rightly. An honest player, who came before, sees every change all the while.
#include <gtest/gtest.h>

#include "tests/support/attack_fixture.h"
#include "tests/support/holds.h"
#include "tests/support/web_client.h"
#include "tests/support/web_folder.h"

namespace scree {
namespace {

class RebindingTest : public AttackTest {
 protected:
  void open_web(const std::function<void(NetConfig&)>& change = {}) {
    open([&](NetConfig& config) {
      config.web.folder = folder.path();
      if (change) change(config);
    });
  }
  HttpAnswer ask(const std::string& host, const std::string& path, const std::string& fields = "") {
    return HttpClient(server->port()).ask_for(host).get(path, fields);
  }
  /// As the page of this host opens it.
  int opens(const std::string& host, const std::string& fields = "") {
    return ask(host, "/session", websocket_fields + "Origin: http://" + host + "\r\n" + fields).status;
  }
  std::string port() const { return std::to_string(server->port()); }

  WebFolder folder;
};

TEST_F(RebindingTest, a_foreign_name_leads_to_no_page_and_no_session) {
  open_web();
  uint64_t refused = 0;
  for (const std::string host :
       {"evil.example", "evil.example:4177", "EVIL.example.", "localhost.evil.example",
        "127.0.0.1.evil.example", "evil", "[::1].evil.example", "xn--lcalhost-54a"}) {
    for (const char* path : {"/", "/main.js", "/session.json", "/status", "/status.json"})
      EXPECT_EQ(ask(host, path).status, 421) << host << path;
    EXPECT_EQ(opens(host), 421) << host;
    EXPECT_EQ(opens(host, "X-Forwarded-Host: localhost\r\nX-Forwarded-For: 127.0.0.1\r\n"), 421)
        << "nobody is to be believed here";
    refused += 7;
  }
  const std::string words = ask("evil.example:4177", "/").body;
  EXPECT_TRUE(holds(words, "does not know the name \"evil.example\"")) << words;
  EXPECT_TRUE(holds(words, "--web-host evil.example") && holds(words, "SCREE_WEB_HOST=evil.example"))
      << words;
  expect_refused_as(Refusal::host_foreign, refused + 1);
  EXPECT_EQ(ask("evil.example", "/healthz").status, 200) << "a balancer asks by whatever name";
  for (const std::string host : {"localhost", "127.0.0.1", "[::1]", "192.168.0.7"}) {
    EXPECT_EQ(ask(host + ":" + port(), "/").status, 200) << host;
    EXPECT_EQ(opens(host + ":" + port()), 101) << host;
  }
  expect_honest_served();
}

TEST_F(RebindingTest, a_foreign_page_has_no_pass_under_a_number) {
  open_web();
  const std::string attempt = "attempt=" + std::string(32, 'a');
  const std::string origin = "Origin: http://evil.example\r\n";
  EXPECT_EQ(ask("192.168.0.7", "/session?" + attempt, websocket_fields + origin).status, 403);
  const std::string told = ask("192.168.0.7", "/session.json?" + attempt).body;
  const size_t at = told.find("\"pass\":\"");
  ASSERT_NE(at, told.npos) << told;
  EXPECT_EQ(ask("192.168.0.7", "/session?pass=" + told.substr(at + 8, 32), websocket_fields + origin).status,
            403)
      << "who leads a proxy that hides the name here reads that, too";
  expect_refused_as(Refusal::origin_foreign, 2);
  expect_honest_served();
}

TEST_F(RebindingTest, names_that_the_operator_says_lead_to_the_page) {
  open_web([](NetConfig& config) {
    config.web.hosts = {"play.example.org", "hill"};
    config.web.origins = {"https://friend.example"};
  });
  for (const char* host : {"play.example.org", "Play.Example.Org:8080", "hill:4177", "friend.example"}) {
    EXPECT_EQ(ask(host, "/").status, 200) << host;
    EXPECT_EQ(opens(host), 101) << host;
  }
  EXPECT_EQ(ask("localhost", "/session", websocket_fields + "Origin: https://friend.example\r\n").status,
            101);
  for (const char* host : {"evil.example", "example.org", "a.play.example.org"})
    EXPECT_EQ(opens(host), 421) << host;
  EXPECT_EQ(ask("play.example.org", "/session", websocket_fields + "Origin: http://evil.example\r\n").status,
            403);
  expect_honest_served();
}

TEST_F(RebindingTest, a_trusted_proxy_says_the_name_until_the_operator_has_said_it) {
  const std::string by_proxy = "X-Forwarded-For: 192.0.2.7\r\nX-Forwarded-Host: play.example.org\r\n";
  const auto page_of = [&](const std::string& name) {
    return ask("127.0.0.1:4177", "/session",
               websocket_fields + "Origin: http://" + name +
                   "\r\nX-Forwarded-For: 192.0.2.7\r\nX-Forwarded-Host: " + name + "\r\n")
        .status;
  };
  open_web([](NetConfig& config) { config.proxies = *Proxies::parse({"127.0.0.1"}); });
  EXPECT_EQ(ask("play.example.org", "/", "X-Forwarded-For: 192.0.2.7\r\n").status, 200);
  EXPECT_EQ(opens("play.example.org", "X-Forwarded-For: 192.0.2.7\r\n"), 101);
  EXPECT_EQ(page_of("play.example.org"), 101) << "the name of the upstream is the proxy's matter";
  EXPECT_EQ(opens("evil.example"), 421) << "who names nobody may be a browser on the proxy's machine";
  EXPECT_EQ(ask("127.0.0.1:4177", "/session", websocket_fields + "Origin: http://evil.example\r\n" + by_proxy)
                .status,
            403)
      << "the page is not of the name that the proxy says";
  expect_honest_served();
  open_web([](NetConfig& config) {
    config.proxies = *Proxies::parse({"127.0.0.1"});
    config.web.hosts = {"play.example.org"};
  });
  EXPECT_EQ(page_of("play.example.org"), 101);
  EXPECT_EQ(page_of("evil.example"), 421);
  EXPECT_EQ(opens("evil.example", "X-Forwarded-For: 192.0.2.7\r\n"), 421);
  expect_honest_served();
}

}  // namespace
}  // namespace scree
