// Players behind Debian's nginx and haproxy: each is counted, limited and banned by the own address, and told
// so in the language of HTTP. Each test has an honest player beside it.
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/proxy/proxy_fixture.h"

namespace scree {
namespace {

using Crowd = std::map<int, std::vector<std::unique_ptr<WebSocketClient>>>;

constexpr size_t connections_each = limits::connections_per_address_max;

class ProxyHttpTest : public ProxyTest {
 protected:
  /// Every user loads the page, and joins by as many connections as an address may have.
  Crowd fill() {
    Crowd crowd;
    for (int user = 1; user <= users; ++user) {
      HttpClient browser(by_proxy(user));
      EXPECT_TRUE(holds(browser.get("/").body, "<title>page</title>")) << user;
      EXPECT_EQ(browser.get("/main.js").status, 200) << user;
      for (size_t i = 0; i < connections_each; ++i) {
        auto& client = crowd[user].emplace_back(std::make_unique<WebSocketClient>(by_proxy(user), origin()));
        EXPECT_EQ(client->handshake().status, 101) << user << ", " << i << ": " << client->handshake().body;
        if (!client->open()) return crowd;
        EXPECT_EQ(join(*client), "") << user << ", " << i;
      }
    }
    return crowd;
  }
  static std::string origin() {
    return "Origin: http://" + proxy_address + ":" + std::to_string(proxy_port) + "\r\n";
  }

  /// What all that is true of, whatever the proxy.
  void expect_real_addresses() {
    const Crowd crowd = fill();
    for (int user = 1; user <= users; ++user) {
      WebSocketClient more(by_proxy(user), origin());
      EXPECT_EQ(more.handshake().status, 429) << "one too many of " << user;
      EXPECT_TRUE(holds(more.handshake().body, "from your address")) << more.handshake().body;
    }
    RawClient admin(server->port());
    ASSERT_EQ(join(admin, the_admin_token), "");
    ASSERT_TRUE(admin.send(AdminMessage{1, "", ListSessionsRequest{}}));
    const auto list = admin.receive_as<AdminListMessage>();
    ASSERT_TRUE(list);
    std::map<std::string, size_t> sessions;
    for (const SessionRow& row : list->sessions) ++sessions[row.address];
    for (int user = 1; user <= users; ++user) EXPECT_EQ(sessions[address_of(user)], connections_each);
    ASSERT_TRUE(admin.send(AdminMessage{2, "", BanRequest{0, address_of(2), 0, "too loud"}}));
    ASSERT_TRUE(admin.receive_as<ReplyMessage>());
    for (const auto& client : crowd.at(2)) {
      const auto refusal = client->receive_as<RefusalMessage>();
      ASSERT_TRUE(refusal);
      EXPECT_EQ(refusal->name, "banned");
    }
    tick();
    EXPECT_TRUE(crowd.at(3).front()->receive_as<FrameMessage>()) << "the others play on";
    expect_witness_unmoved();
  }
};

TEST_F(ProxyHttpTest, nginx_brings_every_player_under_the_own_address) {
  open();
  run_nginx(documented("nginx"));
  expect_real_addresses();
}

TEST_F(ProxyHttpTest, haproxy_brings_every_player_under_the_own_address) {
  open();
  run_haproxy(documented("haproxy"));
  expect_real_addresses();
}

TEST_F(ProxyHttpTest, a_player_may_not_take_anothers_address) {
  open([](NetConfig& config) { config.door.connections_max = 1; });
  run_nginx(documented("nginx"));
  const auto pretends = [&](const std::string& whom) {
    return std::make_unique<WebSocketClient>(by_proxy(1), origin() + "X-Forwarded-For: " + whom + "\r\n");
  };
  const auto first = pretends(address_of(2));
  EXPECT_TRUE(first->open());
  EXPECT_EQ(pretends(address_of(3))->handshake().status, 429) << "it is the first one's sender again";
  WebSocketClient other(by_proxy(2), origin());
  EXPECT_TRUE(other.open()) << "whose place nobody has taken";
  WebSocketClient here(server->port(), "X-Forwarded-For: 192.0.2.1\r\n");
  EXPECT_TRUE(here.open()) << "a program on the trusted machine may say so";
  WebSocketClient again(server->port(), "X-Forwarded-For: 192.0.2.1\r\n");
  EXPECT_EQ(again.handshake().status, 429);
}

TEST_F(ProxyHttpTest, a_proxy_that_is_not_trusted_is_one_address) {
  open([](NetConfig& config) {
    config.proxies = {};
    config.door = {3, 10.0, 64.0, false};
  });
  run_nginx(documented("nginx"));
  WebSocketClient first(by_proxy(1), origin()), second(by_proxy(2), origin());
  EXPECT_TRUE(first.open() && second.open());
  WebSocketClient third(by_proxy(3), origin());
  EXPECT_EQ(third.handshake().status, 429) << "the witness has the third place, and the answer is HTTP";
  EXPECT_TRUE(holds(third.handshake().body, "connections-per-address")) << third.handshake().body;
}

// ---- configurations as beginners write them

class BeginnersProxyTest : public ProxyTest {
 protected:
  /// The server of a beginner on one machine, without options.
  void open_with(const std::string& location, const std::string& lines) {
    open([](NetConfig& config) { config.proxies = {}; });
    run_nginx("server { listen " + place() + "; location " + location + " { proxy_pass http://127.0.0.1:" +
              std::to_string(server->port()) + (location == "/" ? "" : "/") + "; " + lines + " } }\n");
  }
  static std::string place() { return proxy_address + ":" + std::to_string(proxy_port); }
  static std::string attempt(const std::string& folder, const std::string& pass = "") {
    return folder + "session?attempt=0123456789abcdef0123456789abcdef" +
           (pass.empty() ? "" : "&pass=" + pass);
  }
  /// As the page opens a WebSocket, and asks what the server saw of it.
  nlohmann::json told(const std::string& folder = "/") {
    HttpClient browser(by_proxy(1));
    const HttpAnswer answer = browser.get(folder + "session.json?attempt=0123456789abcdef0123456789abcdef");
    EXPECT_EQ(answer.status, 200);
    return nlohmann::json::parse(answer.body, nullptr, false);
  }
  std::unique_ptr<WebSocketClient> try_to_join(const std::string& folder = "/", const std::string& pass = "",
                                               const std::string& origin = "http://" + place()) {
    return std::make_unique<WebSocketClient>(by_proxy(1), "Origin: " + origin + "\r\n", nullptr, 0,
                                             attempt(folder, pass));
  }
  static constexpr const char* upgrade =
      "proxy_http_version 1.1; proxy_set_header Upgrade $http_upgrade; proxy_set_header Connection "
      "\"upgrade\"; ";
};

TEST_F(BeginnersProxyTest, without_upgrade_the_page_names_the_lines_that_are_missing) {
  open_with("/", "");
  EXPECT_EQ(try_to_join()->handshake().status, 426);
  const auto json = told();
  ASSERT_TRUE(json["seen"].get<bool>());
  const std::string words = json["words"];
  EXPECT_TRUE(holds(words, "proxy_http_version 1.1;")) << words;
  EXPECT_TRUE(holds(words, "proxy_set_header Upgrade $http_upgrade;")) << words;
  EXPECT_TRUE(holds(words, "proxy_set_header Connection \"upgrade\";")) << words;
}

TEST_F(BeginnersProxyTest, with_one_line_of_three_the_page_names_the_other_two) {
  open_with("/", "proxy_http_version 1.1;");
  EXPECT_EQ(try_to_join()->handshake().status, 426);
  const std::string words = told()["words"];
  EXPECT_FALSE(holds(words, "proxy_http_version")) << words;
  EXPECT_TRUE(holds(words, "proxy_set_header Upgrade $http_upgrade;")) << words;
}

TEST_F(BeginnersProxyTest, without_host_a_page_joins_by_its_pass) {
  open_with("/", upgrade);
  EXPECT_EQ(try_to_join()->handshake().status, 403) << "the server knows nothing of the page's site";
  const std::string pass = told()["pass"];
  const auto client = try_to_join("/", pass);
  EXPECT_EQ(client->handshake().status, 101) << client->handshake().body;
  EXPECT_EQ(join(*client), "");
  EXPECT_EQ(try_to_join("/", std::string(pass.rbegin(), pass.rend()))->handshake().status, 403);
}

TEST_F(BeginnersProxyTest, under_a_name_the_server_asks_for_the_lines_that_name_the_visitor) {
  open_with("/", upgrade);
  const std::string origin = "http://play.example.org";
  EXPECT_EQ(try_to_join("/", "", origin)->handshake().status, 403);
  const auto json = told();
  EXPECT_EQ(try_to_join("/", json["pass"], origin)->handshake().status, 403)
      << "a foreign page may have made a name lead here";
  const std::string words = told()["words"];
  EXPECT_TRUE(holds(words, "proxy_set_header Host $http_host;")) << words;
  EXPECT_TRUE(holds(words, "proxy_set_header X-Forwarded-For $proxy_add_x_forwarded_for;")) << words;
  EXPECT_TRUE(holds(words, "--web-origin http://play.example.org")) << words;
}

TEST_F(BeginnersProxyTest, by_the_book_a_page_joins_at_once) {
  open_with("/", std::string(upgrade) +
                     "proxy_set_header Host $http_host; proxy_set_header X-Forwarded-For "
                     "$proxy_add_x_forwarded_for;");
  const auto client = try_to_join();
  EXPECT_EQ(client->handshake().status, 101);
  EXPECT_EQ(join(*client), "");
}

TEST_F(BeginnersProxyTest, under_a_path_page_and_session_are_there) {
  open_with("/scree/", std::string(upgrade) + "proxy_set_header Host $http_host;");
  HttpClient browser(by_proxy(1));
  EXPECT_TRUE(holds(browser.get("/scree/").body, "<title>page</title>"));
  EXPECT_EQ(browser.get("/scree/main.js").status, 200);
  EXPECT_EQ(browser.get("/scree/status").status, 200);
  const auto client = try_to_join("/scree/");
  EXPECT_EQ(client->handshake().status, 101) << client->handshake().body;
  EXPECT_EQ(join(*client), "");
}

TEST_F(BeginnersProxyTest, a_path_that_the_proxy_leaves_in_is_named) {
  open();
  run_nginx("server { listen " + place() +
            "; location /scree/ { proxy_pass http://127.0.0.1:" + std::to_string(server->port()) + "; } }\n");
  HttpClient browser(by_proxy(1));
  const HttpAnswer answer = browser.get("/scree/main.js");
  EXPECT_EQ(answer.status, 404);
  EXPECT_TRUE(holds(answer.body, "has to take that path away")) << answer.body;
}

// ---- proxies that tell nothing: whom they bring has no more rights than any stranger

class SilentProxyTest : public ProxyTest {
 protected:
  /// A server without a token, and nginx before it, which sends nothing of its own.
  void open_silent(const std::function<void(NetConfig&)>& change = {}) {
    open([&](NetConfig& config) {
      config.proxies = {};
      config.admin_token.clear();
      config.control = [](const ControlReplayRequest&) { return Result<void>(); };
      config.status = [](const NetFigures&) { return std::string("{}"); };
      if (change) change(config);
    });
    run_nginx("server { listen " + proxy_address + ":" + std::to_string(proxy_port) +
              "; location / { proxy_pass http://127.0.0.1:" + std::to_string(server->port()) +
              "; proxy_http_version 1.1; proxy_set_header Upgrade $http_upgrade; proxy_set_header Connection "
              "\"upgrade\"; } }\n");
  }
  /// As the page does: with a pass, because the proxy hides the page's site.
  std::unique_ptr<WebSocketClient> stranger(int user) {
    const std::string attempt = "attempt=" + std::string(31, 'a') + std::to_string(user % 10);
    const std::string origin = "Origin: http://" + proxy_address + ":" + std::to_string(proxy_port) + "\r\n";
    if (pass_.empty()) {
      WebSocketClient first(by_proxy(user), origin, nullptr, 0, "/session?" + attempt);
      EXPECT_EQ(first.handshake().status, 403);
      const auto told =
          nlohmann::json::parse(HttpClient(by_proxy(user)).get("/session.json?" + attempt).body);
      pass_ = told.value("pass", "");
    }
    return std::make_unique<WebSocketClient>(by_proxy(user), origin, nullptr, 0,
                                             "/session?" + attempt + "&pass=" + pass_);
  }
  bool may_control(auto& client) {
    EXPECT_TRUE(client.send(AdminMessage{9, "", ControlReplayRequest{}}));
    const auto reply = client.template receive_as<ReplyMessage>();
    return reply && reply->refusal.empty();
  }
  /// Who asks for a carve, one after the other, by their parties.
  std::set<uint64_t> parties_of(std::vector<std::unique_ptr<WebSocketClient>>& clients) {
    std::set<uint64_t> parties;
    for (auto& client : clients) {
      EXPECT_TRUE(client->send(carve(1)));
      bool has_asked = false;
      for (const Within within(10.0); !has_asked && !within.over(); wait_a_moment())
        for (const Command& command : commands.drain())
          if (!std::holds_alternative<LeaveRequest>(command.body)) {
            parties.insert(party_of(command));
            has_asked = true;
          }
      EXPECT_TRUE(has_asked);
    }
    return parties;
  }

 private:
  std::string pass_;
};

TEST_F(SilentProxyTest, strangers_share_one_party_and_the_connections_of_one_address) {
  open_silent();
  RawClient own(server->port());
  EXPECT_EQ(join(own), "");
  EXPECT_TRUE(may_control(own)) << "nobody has come by the proxy";
  EXPECT_EQ(HttpClient(server->port()).get("/status.json").status, 200);
  std::vector<std::unique_ptr<WebSocketClient>> strangers;
  for (int user = 1; user <= users; ++user) {
    strangers.push_back(stranger(user));
    ASSERT_EQ(strangers.back()->handshake().status, 101) << strangers.back()->handshake().body;
    EXPECT_EQ(join(*strangers.back()), "");
    EXPECT_FALSE(may_control(*strangers.back()));
  }
  EXPECT_EQ(parties_of(strangers).size(), 1U);
  size_t in = strangers.size();
  for (std::unique_ptr<WebSocketClient> more = stranger(1); more->open() && in < 1000; more = stranger(1)) {
    strangers.push_back(std::move(more));
    ++in;
  }
  EXPECT_LE(in, limits::connections_per_address_max);
  EXPECT_GE(in + users, limits::connections_per_address_max) << "requests of pages may still be open";
  EXPECT_FALSE(may_control(own)) << "from now on anybody may be behind a connection from loopback";
  EXPECT_EQ(HttpClient(server->port()).get("/status.json").status, 403);
  expect_witness_unmoved();
}

TEST_F(SilentProxyTest, nobody_has_loopbacks_rights_under_a_public_name_or_beside_a_named_proxy) {
  for (const bool named : {false, true}) {
    open_silent([&](NetConfig& config) {
      if (named) config.proxies = *Proxies::parse({"192.0.2.1"});
      if (!named) config.web.hosts = {"play.example.org"};
    });
    RawClient own(server->port());
    EXPECT_EQ(join(own), "");
    EXPECT_FALSE(may_control(own));
    EXPECT_EQ(HttpClient(by_proxy(1)).get("/status.json").status, 403);
    EXPECT_EQ(HttpClient(server->port()).get("/status.json").status, 403);
    expect_witness_unmoved();
    seen = source.tick();
  }
}

// ---- the PROXY protocol, for players who are no browsers

class ProxyHeaderTest : public ProxyTest {
 protected:
  void expect_real_addresses(const std::string& sends) {
    open([](NetConfig& config) { config.door.connections_max = 2; });
    std::string section = documented("haproxy", 1);
    const std::string written = "send-proxy-v2";
    ASSERT_NE(section.find(written), section.npos);
    run_haproxy(section.replace(section.find(written), written.size(), sends));
    std::vector<std::unique_ptr<RawClient>> clients;
    for (int user = 1; user <= users; ++user)
      for (int i = 0; i < 2; ++i) {
        clients.push_back(std::make_unique<RawClient>(by_proxy(user)));
        EXPECT_EQ(join(*clients.back()), "") << user;
      }
    RawClient more(by_proxy(1));
    EXPECT_EQ(join(more), "connections_per_address");
    HttpClient browser(by_proxy(1));
    EXPECT_EQ(browser.get("/").status, 429) << "likewise, and by HTTP";
    RawClient admin(server->port());
    ASSERT_EQ(join(admin, the_admin_token), "") << "the trusted machine's own programs send no header";
    ASSERT_TRUE(admin.send(AdminMessage{2, "", BanRequest{0, address_of(2), 0, "too loud"}}));
    ASSERT_TRUE(admin.receive_as<ReplyMessage>());
    clients.erase(clients.begin() + 2, clients.begin() + 4);
    std::string answer;
    for (const Within within(30.0); answer != "banned" && !within.over();) {
      RawClient banned(by_proxy(2));
      answer = join(banned);
    }
    EXPECT_EQ(answer, "banned");
    tick();
    EXPECT_TRUE(clients.back()->receive_as<FrameMessage>());
    expect_witness_unmoved();
  }
};

TEST_F(ProxyHeaderTest, haproxy_names_its_clients_by_version_1) {
  expect_real_addresses("send-proxy");
}

TEST_F(ProxyHeaderTest, haproxy_names_its_clients_by_version_2) {
  expect_real_addresses("send-proxy-v2");
}

TEST_F(ProxyHeaderTest, nobody_else_is_believed) {
  open([](NetConfig& config) { config.proxies = *Proxies::parse({"192.0.2.0/24"}); });
  RawClient liar(server->port());
  const std::string header = "PROXY TCP4 203.0.113.7 203.0.113.1 50000 4177\r\n";
  ASSERT_TRUE(liar.send_bytes(std::span(reinterpret_cast<const uint8_t*>(header.data()), header.size())));
  EXPECT_TRUE(liar.closed_within(seconds(10))) << "it is no request";
  RawClient honest(server->port());
  EXPECT_EQ(join(honest), "");
  expect_witness_unmoved();
}

TEST_F(ProxyHeaderTest, a_broken_header_ends_its_connection_and_no_other) {
  open();
  for (const char* header :
       {"PROXY TCP4 nonsense\r\n", "PROXY TCP4 1.2.3.4 1.2.3.4 99999 1\r\n", "PROXY TCP9 a b 1 2\r\n"}) {
    RawClient broken(server->port());
    ASSERT_TRUE(
        broken.send_bytes(std::span(reinterpret_cast<const uint8_t*>(header), std::string(header).size())));
    EXPECT_TRUE(broken.closed_within(seconds(10))) << header;
  }
  const auto counted = [&] { return server->stats().refusals.of(Refusal::stream_malformed); };
  for (const Within within(30.0); counted() < 3 && !within.over();) wait_a_moment();
  EXPECT_EQ(counted(), 3U);
  expect_witness_unmoved();
}

}  // namespace
}  // namespace scree
