// HTTP and WebSocket by the server's own port, plainly and by TLS.
#include <gtest/gtest.h>

#include "client/mirror/mirror.h"
#include "server/app/live_server.h"
#include "server/doors/limits.h"
#include "shared/base/timing.h"
#include "tests/support/certificates.h"
#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/web_client.h"
#include "tests/support/web_folder.h"

namespace scree {
namespace {

class WebServerTest : public NetServerTest {
 protected:
  void open(const std::function<void(NetConfig&)>& change = {}) {
    start([&](NetConfig& config) {
      config.web.folder = folder.path();
      if (change) change(config);
    });
  }
  /// The server's context; for a client that trusts it.
  std::shared_ptr<const TlsClientContext> open_with_tls(bool required = false) {
    TestCertificate("DNS:localhost").write(files / "certificate", files / "key");
    const auto change = [&](NetConfig& config) {
      config.web.folder = folder.path();
      config.access.tls_certificate_path = files / "certificate";
      config.access.tls_key_path = files / "key";
      config.access.tls_required = required;
    };
    NetConfig config;
    config.terrain = flat_terrain;
    config.heartbeat_s = 0.0;
    change(config);
    auto listening = NetServer::listen(config, commands, source.keyframe());
    EXPECT_TRUE(listening.has_value());
    server = std::move(*listening);
    return *TlsClientContext::make({files / "certificate", ""});
  }
  /// Joins, has something carved, and compares hashes.
  void expect_session(WebSocketClient& client) {
    ASSERT_TRUE(client.open());
    ASSERT_TRUE(client.send(hello()));
    const auto welcome = client.receive_as<WelcomeMessage>();
    ASSERT_TRUE(welcome);
    Mirror mirror(*welcome);
    ASSERT_TRUE(client.send(carve(1)));
    std::vector<Command> asked;
    for (const Within within(60.0); asked.empty() && !within.over();) asked = commands.drain();
    ASSERT_EQ(asked.size(), 1U);
    EXPECT_TRUE(std::holds_alternative<CarveRequest>(asked.front().body));
    tick({source.carve({}, 1.0F, 4)});
    for (int i = 0; i < 3; ++i) tick();
    while (mirror.tick() < source.tick()) {
      const auto message = client.receive();
      ASSERT_TRUE(message);
      ASSERT_TRUE(mirror.apply(*message));
    }
    EXPECT_EQ(mirror.field().hash(), source.field().hash());
  }

  WebFolder folder;
  TestFolder files;
};

TEST_F(WebServerTest, serves_the_page_isolated_and_by_itself_alone) {
  open();
  HttpClient client(server->port());
  const HttpAnswer page = client.get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_TRUE(holds(page.body, "<title>page</title>"));
  EXPECT_EQ(page.field("Cross-Origin-Opener-Policy"), "same-origin");
  EXPECT_EQ(page.field("Cross-Origin-Embedder-Policy"), "require-corp");
  EXPECT_EQ(page.field("X-Content-Type-Options"), "nosniff");
  EXPECT_TRUE(holds(page.field("Content-Security-Policy"),
                    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'"));
  EXPECT_FALSE(page.field("Date").empty());
  EXPECT_EQ(page.field("Connection"), "keep-alive");
  EXPECT_TRUE(holds(client.get("/healthz").body, "\"well\":true")) << "on the same connection";
  EXPECT_EQ(client.get("/client.0123abcd.wasm", "Accept-Encoding: gzip\r\n").body, "compressed wasm");
  EXPECT_EQ(client.get("/", "If-None-Match: " + page.field("ETag") + "\r\n").status, 304);
  const HttpAnswer head = client.get("/", "", "HEAD");
  EXPECT_EQ(head.field("Content-Length"), std::to_string(page.body.size()));
  EXPECT_TRUE(head.body.empty());
  EXPECT_EQ(client.get("/nothing").status, 404) << "nothing of the head's body is in between";
  EXPECT_EQ(client.get("/", "Connection: close\r\n").field("Connection"), "close");
  EXPECT_TRUE(client.pipe().ends());
  tick();
  const WebStats web = server->stats().web;
  EXPECT_EQ(web.requests, 7U);
  EXPECT_EQ(web.files, 4U);
  EXPECT_EQ(web.not_modified, 1U);
  expect_witness_unmoved();
}

TEST_F(WebServerTest, answers_requests_that_come_at_once_in_their_order) {
  open();
  HttpClient client(server->port());
  std::string many;
  for (int i = 0; i < 100; ++i)
    many += std::string("GET ") + (i % 2 == 0 ? "/healthz" : "/main.js") +
            " HTTP/1.1\r\nHost: localhost\r\n\r\n\r\n";
  ASSERT_TRUE(client.pipe().send(many));
  for (int i = 0; i < 100; ++i)
    ASSERT_TRUE(holds(client.answer().body, i % 2 == 0 ? "\"well\":true" : "let a = 1;")) << i;
}

TEST_F(WebServerTest, answers_a_request_that_comes_byte_by_byte) {
  open();
  HttpClient client(server->port());
  for (const char c : std::string("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"))
    ASSERT_TRUE(client.pipe().send(std::string_view(&c, 1)));
  EXPECT_EQ(client.answer().status, 200);
}

TEST_F(WebServerTest, sends_large_files_whole) {
  const std::string large(3'000'000, 'x');
  folder.write("large.bin", large);
  open();
  HttpClient client(server->port());
  EXPECT_EQ(client.get("/large.bin").body, large);
  EXPECT_EQ(client.get("/healthz").status, 200);
}

TEST_F(WebServerTest, carries_a_whole_session_by_websocket) {
  open();
  WebSocketClient client(server->port());
  EXPECT_EQ(client.handshake().field("Sec-WebSocket-Accept"), "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
  expect_session(client);
  EXPECT_EQ(server->stats().web.websockets, 1U);
  EXPECT_EQ(server->stats().sessions, 2U);
  EXPECT_EQ(server->stats().web.connections, 0U);
  expect_witness_unmoved();
}

TEST_F(WebServerTest, brings_who_paused_up_to_date_in_order) {
  const auto tls = open_with_tls();
  for (const auto& context : {std::shared_ptr<const TlsClientContext>(), tls}) {
    WebSocketClient client(server->port(), "", context, 4096);
    ASSERT_TRUE(client.send(hello()));
    const auto welcome = client.receive_as<WelcomeMessage>();
    ASSERT_TRUE(welcome);
    Mirror mirror(*welcome);
    for (int i = 0; i < 60; ++i)
      tick({source.carve(
          {static_cast<float>(i % 8) * 4.0F - 16.0F, 0.0F, static_cast<float>(i / 8) * 4.0F - 16.0F}, 1.5F,
          24)});
    const auto is_up_to_date = [&] { return mirror.field().hash() == source.field().hash(); };
    for (const Within within(60.0); !is_up_to_date() && !within.over();) {
      tick();
      while (mirror.tick() < source.tick()) {
        const auto message = client.receive();
        ASSERT_TRUE(message);
        ASSERT_TRUE(mirror.apply(*message));
      }
    }
    EXPECT_TRUE(is_up_to_date());
    EXPECT_EQ(client.close_code(), 0);
  }
}

TEST_F(WebServerTest, carries_messages_cut_into_fragments_anyhow) {
  open();
  WebSocketClient client(server->port());
  const std::vector<uint8_t> bytes = encode(ClientMessage(hello()));
  for (size_t i = 0; i < bytes.size(); ++i)
    ASSERT_TRUE(client.send_frame(std::span(bytes).subspan(i, 1),
                                  {.opcode = uint8_t(i == 0 ? 2 : 0), .fin = i + 1 == bytes.size()}));
  EXPECT_TRUE(client.receive_as<WelcomeMessage>());
  ASSERT_TRUE(client.send_frame({}, {.opcode = 9}));
  while (client.pongs() == 0) ASSERT_TRUE(client.fill());
}

TEST_F(WebServerTest, ends_a_session_of_a_websocket_that_closes) {
  open();
  WebSocketClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  ASSERT_TRUE(client.receive_as<WelcomeMessage>());
  ASSERT_TRUE(client.send_frame(std::vector<uint8_t>{0x03, 0xe8}, {.opcode = 8}));
  EXPECT_TRUE(client.ends());
  EXPECT_EQ(client.close_code(), 1000) << "and answers it";
  expect_witness_unmoved();
}

TEST_F(WebServerTest, closes_websockets_in_order_when_it_refuses_their_session) {
  open();
  WebSocketClient client(server->port());
  ASSERT_TRUE(client.send(hello(protocol_version + 1)));
  const auto refusal = client.receive_as<RefusalMessage>();
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->name, "protocol_version");
  while (client.close_code() == 0) ASSERT_TRUE(client.fill());
  EXPECT_EQ(client.close_code(), 1000);
}

TEST_F(WebServerTest, says_all_of_it_by_tls) {
  const auto tls = open_with_tls();
  HttpClient client(server->port(), tls);
  EXPECT_EQ(client.get("/").status, 200);
  WebSocketClient websocket(server->port(),
                            "Origin: https://localhost:" + std::to_string(server->port()) + "\r\n", tls);
  expect_session(websocket);
  HttpClient plain(server->port());
  EXPECT_EQ(plain.get("/healthz").status, 200);
  RawClient bytes(server->port());
  EXPECT_TRUE(bytes.send(hello()));
  EXPECT_TRUE(bytes.receive_as<WelcomeMessage>());
}

TEST_F(WebServerTest, sends_who_comes_plainly_to_tls_where_it_is_required) {
  const auto tls = open_with_tls(true);
  HttpClient plain(server->port());
  const HttpAnswer answer = plain.get("/main.js");
  EXPECT_EQ(answer.status, 307);
  EXPECT_EQ(answer.field("Location"), "https://" + plain.host() + "/main.js");
  HttpClient client(server->port(), tls);
  EXPECT_EQ(client.get("/main.js").status, 200);
}

TEST_F(WebServerTest, gives_tokens_the_same_rights_by_websocket) {
  open([](NetConfig& config) {
    config.admin_token = "the-admin-token";
    config.access.anonymous = Role::builder;
  });
  WebSocketClient client(server->port());
  HelloMessage with_token = hello();
  with_token.token = "the-admin-token";
  ASSERT_TRUE(client.send(with_token));
  const auto welcome = client.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome);
  EXPECT_EQ(welcome->role, Role::admin);
}

TEST_F(WebServerTest, counts_a_websocket_among_the_connections_of_its_address) {
  open([](NetConfig& config) {
    config.door.loopback_is_free = false;
    config.door.connections_max = 3;
    config.door.connects_burst = 100.0;
  });
  WebSocketClient first(server->port()), second(server->port());
  EXPECT_TRUE(first.open() && second.open());
  HttpClient third(server->port());
  const HttpAnswer no = third.get("/");
  EXPECT_EQ(no.status, 429) << "the witness has the third place, and who speaks HTTP is told so by it";
  EXPECT_TRUE(holds(no.body, "connections-per-address"));
  EXPECT_TRUE(third.pipe().ends());
  WebSocketClient fourth(server->port());
  EXPECT_EQ(fourth.handshake().status, 429);
  EXPECT_EQ(server->stats().turned_away, 2U);
  EXPECT_EQ(server->stats().refusals.of(Refusal::connections_per_address), 2U) << "each is counted once";
  expect_witness_unmoved();
}

TEST_F(WebServerTest, holds_few_of_those_that_it_turns_away_in_a_second) {
  open([](NetConfig& config) {
    config.door.loopback_is_free = false;
    config.door.connections_max = 1;
    config.door.connects_burst = 1000.0;
  });
  constexpr size_t tries = 150;
  const double begun_s = steady_now_s();
  size_t told = 0;
  for (size_t i = 0; i < tries; ++i) {
    HttpClient client(server->port());
    if (client.get("/").status == 429) ++told;
  }
  const double most = static_cast<double>(limits::turned_away_max) +
                      limits::turned_away_per_second_max * (steady_now_s() - begun_s) + 1.0;
  EXPECT_GT(told, 0U);
  EXPECT_LE(static_cast<double>(told), most) << "the others are told in the protocol's language";
  EXPECT_EQ(server->stats().turned_away, tries);
  expect_witness_unmoved();
}

TEST_F(WebServerTest, tells_its_health_plainly_where_tls_is_required_and_where_it_is_full) {
  const auto tls = open_with_tls(true);
  HttpClient plain(server->port());
  for (const char* path : {"/healthz", "/livez", "/readyz"}) {
    const HttpAnswer answer = plain.get(path);
    EXPECT_EQ(answer.status, 200) << path;
    EXPECT_EQ(answer.field("Content-Type"), "application/json");
    EXPECT_EQ(answer.field("Cache-Control"), "no-store");
  }
  RawClient bytes(server->port());
  ASSERT_TRUE(bytes.send(AskHealthMessage{}));
  EXPECT_TRUE(bytes.receive_as<HealthMessage>());
}

TEST_F(WebServerTest, speaks_no_http_where_it_is_off) {
  open([](NetConfig& config) { config.web.on = false; });
  RawClient client(server->port());
  const std::string get = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
  ASSERT_TRUE(client.send_bytes(std::span(reinterpret_cast<const uint8_t*>(get.data()), get.size())));
  const auto refusal = client.receive_as<RefusalMessage>();
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->name, "message_malformed");
}

TEST_F(WebServerTest, reads_the_page_again_when_it_is_told_to) {
  open();
  HttpClient client(server->port());
  folder.write("index.html", "new");
  EXPECT_TRUE(holds(client.get("/").body, "page"));
  ASSERT_TRUE(server->reload());
  for (const Within within(60.0); client.get("/").body != "new";) ASSERT_FALSE(within.over());
  std::filesystem::remove_all(folder.path());
  EXPECT_FALSE(server->reload());
  EXPECT_EQ(client.get("/").body, "new");
}

TEST_F(WebServerTest, does_not_start_without_the_folder_that_it_is_told) {
  NetConfig config;
  config.terrain = flat_terrain;
  config.web.folder = folder.path() + "nowhere";
  const auto listening = NetServer::listen(config, commands, source.keyframe());
  ASSERT_FALSE(listening);
  EXPECT_TRUE(holds(listening.error().message, "--web"));
}

}  // namespace
}  // namespace scree
