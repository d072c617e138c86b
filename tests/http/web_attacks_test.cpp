// Attacks by HTTP and WebSocket on loopback, with honest clients beside each. All are served, their copies
// have the server's hash, each attack is counted under its name, and the log stays short.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "client/mirror/mirror.h"
#include "tests/support/attack_fixture.h"
#include "tests/support/web_client.h"
#include "tests/support/web_folder.h"

namespace scree {
namespace {

class WebAttackTest : public AttackTest {
 protected:
  void open_web(const std::function<void(NetConfig&)>& change = {}) {
    open([&](NetConfig& config) {
      config.web.folder = folder.path();
      if (change) change(config);
    });
  }
  /// People by the protocol, a page, and somebody by a WebSocket.
  void expect_all_served() {
    expect_honest_served();
    EXPECT_EQ(HttpClient(server->port()).get("/").status, 200);
    WebSocketClient person(server->port());
    ASSERT_TRUE(person.send(hello()));
    EXPECT_TRUE(person.receive_as<WelcomeMessage>());
  }
  /// A WebSocket that has joined sends this, and the server closes it with the code.
  void expect_closed(const std::vector<uint8_t>& frames, uint16_t code) {
    WebSocketClient attacker(server->port());
    ASSERT_TRUE(attacker.send(hello()));
    ASSERT_TRUE(attacker.receive_as<WelcomeMessage>());
    const uint64_t before = server->stats().refusals.of(Refusal::stream_malformed);
    ASSERT_TRUE(attacker.pipe().send(frames));
    EXPECT_TRUE(attacker.ends());
    EXPECT_EQ(attacker.close_code(), code);
    expect_refused_as(Refusal::stream_malformed, before + 1);
    expect_all_served();
  }
  /// Status of a request with these fields to the path of the WebSocket.
  int handshake(const std::string& fields, const std::string& method = "GET") {
    return HttpClient(server->port()).get("/session", fields, method).status;
  }

  WebFolder folder;
};

TEST_F(WebAttackTest, heads_that_come_slowly_or_not_at_all) {
  open_web([](NetConfig& config) { config.web.head_seconds = 0.0; });
  HttpClient slow(server->port()), silent_within(server->port()), empty_lines(server->port());
  EXPECT_TRUE(slow.pipe().send("GET / HTTP/1.1\r\nX-Slow: "));
  EXPECT_TRUE(silent_within.pipe().send("GET"));
  EXPECT_TRUE(empty_lines.pipe().send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n\r\n\r\n"));
  EXPECT_TRUE(slow.pipe().ends() && silent_within.pipe().ends() && empty_lines.pipe().ends());
  expect_refused_as(Refusal::http_late, 3);
  expect_honest_served();
}

TEST_F(WebAttackTest, connections_that_ask_once_and_stay) {
  open_web([](NetConfig& config) { config.web.idle_seconds = 0.0; });
  HttpClient idle(server->port());
  EXPECT_EQ(idle.get("/").status, 200);
  EXPECT_TRUE(idle.pipe().ends());
  expect_all_served();
}

TEST_F(WebAttackTest, heads_without_an_end) {
  open_web();
  HttpClient one_field(server->port()), many_fields(server->port()), one_line(server->port());
  const std::string filler(limits::http_head_bytes_max, 'x');
  EXPECT_EQ(one_field.get("/", "X: " + filler + "\r\n").status, 431);
  std::string fields;
  while (fields.size() < limits::http_head_bytes_max) fields += "A: b\r\n";
  EXPECT_EQ(many_fields.get("/", fields).status, 431);
  EXPECT_EQ(one_line.get("/" + filler).status, 431);
  HttpClient endless(server->port());
  EXPECT_TRUE(endless.pipe().send("GET / HTTP/1.1\r\nX: "));
  for (int i = 0; i < 1000 && endless.pipe().send(filler); ++i) continue;
  EXPECT_TRUE(endless.pipe().ends());
  expect_refused_as(Refusal::http_too_long, 4);
  expect_all_served();
}

TEST_F(WebAttackTest, bytes_that_are_no_request) {
  open_web();
  for (const char* bytes :
       {"GETGETGET\r\n\r\n", "GET / HTTP/9.9\r\nHost: localhost\r\n\r\n", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n", "AAA\r\n\r\n"}) {
    HttpClient attacker(server->port());
    EXPECT_TRUE(attacker.pipe().send(bytes));
    EXPECT_EQ(attacker.answer().status, 400) << bytes;
    EXPECT_TRUE(attacker.pipe().ends());
  }
  expect_refused_as(Refusal::http_malformed, 6);
  expect_all_served();
}

TEST_F(WebAttackTest, handshakes_that_break_the_rules) {
  open_web();
  const std::string upgrade = "Upgrade: websocket\r\nConnection: Upgrade\r\n";
  const std::string version = "Sec-WebSocket-Version: 13\r\n",
                    key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
  EXPECT_EQ(handshake(upgrade + version), 400) << "without a key";
  EXPECT_EQ(handshake(upgrade + version + "Sec-WebSocket-Key: short\r\n"), 400);
  EXPECT_EQ(handshake(upgrade + key + "Sec-WebSocket-Version: 8\r\n"), 426);
  EXPECT_EQ(handshake(upgrade + key), 426) << "without a version";
  EXPECT_EQ(handshake(version + key), 426) << "without the upgrade";
  EXPECT_EQ(handshake(upgrade + version + key, "POST"), 405);
  EXPECT_EQ(handshake(upgrade + version + key, "HEAD"), 405);
  EXPECT_EQ(handshake(upgrade + version + key), 101);
  expect_refused_as(Refusal::http_malformed, 7);
  expect_all_served();
}

TEST_F(WebAttackTest, pages_of_other_sites) {
  open_web([](NetConfig& config) { config.web.origins = {"https://friend.example"}; });
  const auto from = [&](const std::string& origin) {
    return handshake(websocket_fields + "Origin: " + origin + "\r\n");
  };
  EXPECT_EQ(from("http://evil.example"), 403);
  EXPECT_EQ(from("null"), 403);
  EXPECT_EQ(from("https://friend.example"), 101);
  EXPECT_EQ(from("http://localhost:" + std::to_string(server->port())), 101);
  expect_refused_as(Refusal::origin_foreign, 2);
  expect_all_served();
}

TEST_F(WebAttackTest, paths_that_lead_elsewhere) {
  open_web();
  for (const char* path : {"/../etc/passwd", "/parts/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd",
                           "/..%5c..%5cetc", "/..\\..\\etc", "//etc/passwd", "/.git/config",
                           "/proc/self/environ", "/parts/..", "/index.html%00.js"})
    EXPECT_EQ(HttpClient(server->port()).get(path).status, 404) << path;
  for (const char* path : {"http://localhost/index.html", "index.html", "../index.html", "*"})
    EXPECT_EQ(HttpClient(server->port()).get(path).status, 400) << path;
  EXPECT_EQ(HttpClient(server->port()).get(std::string("/index.html\0.js", 15)).status, 400);
  expect_all_served();
}

TEST_F(WebAttackTest, a_thousand_connections) {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = std::min<rlim_t>(files.rlim_max, 8192);
  ::setrlimit(RLIMIT_NOFILE, &files);
  open_web([](NetConfig& config) {
    config.web.head_seconds = config.web.idle_seconds = config.hello_seconds = 1000.0;
  });
  std::vector<std::unique_ptr<HttpClient>> crowd;
  for (int i = 1; i <= 1000; ++i) {
    crowd.push_back(std::make_unique<HttpClient>(server->port()));
    ASSERT_TRUE(crowd.back()->pipe().connected()) << i;
    if (i % 3 == 0) crowd.back()->pipe().send("GET / HTTP/1.1\r\n");
    if (i % 3 == 1) crowd.back()->pipe().send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    if (i % 250 == 0) expect_all_served();
  }
  EXPECT_LE(server->stats().web.connections, limits::outsiders_max);
  EXPECT_GT(server->stats().web.connections, limits::outsiders_max / 3);
}

/// Somebody by a WebSocket, with a copy of the world.
class Person {
 public:
  explicit Person(uint16_t port) : client_(port) {
    if (!client_.send(hello())) return;
    if (const auto welcome = client_.receive_as<WelcomeMessage>()) mirror_.emplace(*welcome);
  }
  bool joined() const { return mirror_.has_value(); }
  std::optional<uint64_t> hash_at(Tick tick) {
    while (mirror_->tick() < tick) {
      const auto message = client_.receive();
      if (!message || !mirror_->apply(*message)) return std::nullopt;
    }
    return mirror_->field().hash();
  }

 private:
  WebSocketClient client_;
  std::optional<Mirror> mirror_;
};

TEST_F(WebAttackTest, all_at_once_beside_ten_by_websocket_and_ten_by_tcp) {
  open_web();
  std::vector<std::unique_ptr<Person>> people;
  std::vector<std::unique_ptr<HonestClient>> viewers;
  for (int i = 0; i < 10; ++i) {
    people.push_back(std::make_unique<Person>(server->port()));
    viewers.push_back(std::make_unique<HonestClient>(server->port()));
    ASSERT_TRUE(people.back()->joined() && viewers.back()->joined());
  }
  const std::string upgrade = "GET /session HTTP/1.1\r\nHost: localhost\r\n" + websocket_fields + "\r\n";
  const auto frame = [](const FrameShape& shape) {
    const auto bytes = websocket_frame(std::vector<uint8_t>{1, 2, 3}, shape);
    return std::string(bytes.begin(), bytes.end());
  };
  const std::vector<std::string> attacks = {
      "GET / HTTP/1.1\r\nX-Slow: ",
      "GET / HTTP/1.1\r\nX: " + std::string(20'000, 'x'),
      "GET /session HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\r\n",
      "GET /session HTTP/1.1\r\nHost: localhost\r\nOrigin: http://b\r\n" + websocket_fields + "\r\n",
      "GET /../../etc/passwd HTTP/1.1\r\nHost: localhost\r\n\r\n",
      "BAD\r\n\r\n",
      upgrade + frame({.masked = false}),
      upgrade + frame({.opcode = 0}),
      upgrade + frame({.says_bytes = uint64_t{1} << 40U}),
      upgrade + frame({.opcode = 1}),
      upgrade + std::string(5000, '\xff')};
  std::vector<std::unique_ptr<WebPipe>> attackers;
  for (int round = 0; round < 8; ++round) {
    for (const std::string& attack : attacks) {
      attackers.push_back(std::make_unique<WebPipe>(server->port()));
      EXPECT_TRUE(attackers.back()->send(attack));
      if (round % 2 == 1) attackers.back()->finish_sending();
    }
    tick({source.carve({static_cast<float>(round) * 2.0F, 0.0F, 8.0F}, 1.0F, 4)});
    tick();
    for (int i = 0; i < 10; ++i) {
      EXPECT_EQ(people[i]->hash_at(source.tick()), source.field().hash()) << i;
      EXPECT_EQ(viewers[i]->hash_at(source.tick()), source.field().hash()) << i;
    }
  }
  expect_all_served();
}

TEST_F(WebAttackTest, more_requests_a_second_than_an_address_may) {
  open_web([](NetConfig& config) {
    config.door.loopback_is_free = false;
    config.door.connections_max = 100;
    config.door.connects_burst = 100.0;
    config.door.requests_per_second = 0.001;
    config.door.requests_burst = 5.0;
  });
  HttpClient attacker(server->port());
  for (int i = 0; i < 5; ++i) EXPECT_EQ(attacker.get("/").status, 200);
  EXPECT_EQ(attacker.get("/").status, 429);
  EXPECT_TRUE(attacker.pipe().ends());
  expect_refused_as(Refusal::http_requests_per_second, 1);
  expect_honest_served();
}

TEST_F(WebAttackTest, frames_without_a_mask) {
  open_web();
  expect_closed(websocket_frame(std::vector<uint8_t>{1, 2, 3}, {.masked = false}), 1002);
}

TEST_F(WebAttackTest, frames_cut_into_fragments_against_the_rules) {
  open_web();
  expect_closed(websocket_frame(std::vector<uint8_t>{1}, {.opcode = 0}), 1002);
}

TEST_F(WebAttackTest, frames_that_are_too_long) {
  open_web();
  expect_closed(websocket_frame(std::vector<uint8_t>{1}, {.says_bytes = uint64_t{1} << 40U}), 1009);
}

TEST_F(WebAttackTest, text_frames) {
  open_web();
  expect_closed(websocket_frame(std::vector<uint8_t>{'a'}, {.opcode = 1}), 1003);
}

TEST_F(WebAttackTest, a_flood_of_pings) {
  open_web();
  std::vector<uint8_t> flood;
  const auto ping = websocket_frame({}, {.opcode = 9});
  for (int i = 0; i < 2000; ++i) flood.insert(flood.end(), ping.begin(), ping.end());
  expect_closed(flood, 1008);
}

TEST_F(WebAttackTest, a_message_of_fragments_without_an_end) {
  open_web();
  WebSocketClient attacker(server->port());
  const std::vector<uint8_t> part(4096, 1);
  ASSERT_TRUE(attacker.send_frame(part, {.fin = false}));
  for (int i = 0; i < 1000 && attacker.send_frame(part, {.opcode = 0, .fin = false}); ++i) continue;
  EXPECT_TRUE(attacker.ends());
  expect_refused_as(Refusal::message_malformed, 1);
  expect_all_served();
}

TEST_F(WebAttackTest, connections_closed_by_half) {
  open_web();
  HttpClient asked(server->port());
  EXPECT_TRUE(asked.pipe().send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  asked.pipe().finish_sending();
  EXPECT_EQ(asked.answer().status, 200) << "what was asked before is answered";
  EXPECT_TRUE(asked.pipe().ends());
  HttpClient half_a_head(server->port());
  EXPECT_TRUE(half_a_head.pipe().send("GET / HTTP/1.1\r\nHo"));
  half_a_head.pipe().finish_sending();
  EXPECT_TRUE(half_a_head.pipe().ends());
  WebSocketClient joined(server->port());
  ASSERT_TRUE(joined.send(hello()));
  ASSERT_TRUE(joined.receive_as<WelcomeMessage>());
  ASSERT_TRUE(joined.send_frame(std::vector<uint8_t>{1, 2}, {.says_bytes = 50}));
  joined.pipe().finish_sending();
  EXPECT_TRUE(joined.ends());
  expect_all_served();
}

TEST_F(WebAttackTest, readers_that_read_nothing) {
  folder.write("large.bin", std::string(8'000'000, 'x'));
  open_web([](NetConfig& config) { config.stall_seconds = 1.0; });
  HttpClient lazy(server->port());
  EXPECT_TRUE(lazy.pipe().send("GET /large.bin HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  expect_refused_as(Refusal::reading_stalled, 1);
  expect_honest_served();
}

}  // namespace
}  // namespace scree
