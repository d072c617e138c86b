// A client's connection: the handshake and its failures, messages both ways, a queue that is bounded, and
// ends of every kind.
#include "client/connection/connection.h"

#include <gtest/gtest.h>
#include <thread>

#include "client/connection/limits.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"
#include "tests/support/raw_server.h"

namespace scree {
namespace {

using namespace std::chrono_literals;

constexpr auto deadline = 10s;

std::string failure(uint16_t port, std::chrono::milliseconds within = deadline) {
  const auto connected = Connection::connect({.port = port}, HelloMessage{}, within);
  return connected ? "" : connected.error().message;
}

/// A server's side of one connection, on a thread that ends with the scope.
template <typename F>
class Answering {
 public:
  Answering(RawServer& server, F&& answer)
      : thread_([&server, answer] {
          if (server.accept()) answer(server);
        }) {}
  ~Answering() { thread_.join(); }

 private:
  std::thread thread_;
};

/// A connection that has been welcomed.
std::unique_ptr<Connection> welcomed(RawServer& server) {
  const Answering answering(server, [](RawServer& s) {
    s.receive();
    s.send(WelcomeMessage{});
  });
  auto connected = Connection::connect({.port = server.port()}, HelloMessage{}, deadline);
  EXPECT_TRUE(connected) << connected.error().message;
  return connected ? std::move(*connected) : nullptr;
}

std::vector<Received> wait_for(Connection& connection, size_t count) {
  std::vector<Received> all;
  const auto end = std::chrono::steady_clock::now() + deadline;
  // Read once more after the end: what arrived before it can still be polled.
  for (bool open = true; open && all.size() < count && std::chrono::steady_clock::now() < end;) {
    open = connection.connected();
    for (Received& received : connection.wait(100ms)) all.push_back(std::move(received));
  }
  return all;
}

void wait_for_close(Connection& connection) {
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (connection.connected() && std::chrono::steady_clock::now() < end) connection.wait(100ms);
  EXPECT_FALSE(connection.connected());
}

TEST(Connection, a_port_without_a_server_is_named) {
  const RawServer closed = RawServer::closed();
  const std::string reason = failure(closed.port());
  EXPECT_TRUE(holds(reason, "127.0.0.1:")) << reason;
  EXPECT_TRUE(holds(reason, "cannot connect")) << reason;
}

TEST(Connection, a_server_that_says_nothing_is_given_up_at_the_deadline) {
  RawServer server;
  EXPECT_TRUE(holds(failure(server.port(), 50ms), "no answer within 50 ms"));
}

TEST(Connection, a_refusal_comes_in_the_servers_own_words) {
  RawServer server;
  const Answering answering(server, [](RawServer& s) {
    s.receive();
    s.send(RefusalMessage{"protocol 2 is not 1"});
    s.hang_up();
  });
  EXPECT_TRUE(holds(failure(server.port()), "the server refused: protocol 2 is not 1"));
}

TEST(Connection, something_that_is_no_server_is_recognised) {
  RawServer server;
  const Answering answering(server, [](RawServer& s) {
    const std::string text = "HTTP/1.1 400 Bad Request\r\n\r\n";
    s.send_bytes({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  });
  EXPECT_TRUE(holds(failure(server.port()), "does not follow this protocol"));
}

TEST(Connection, another_protocol_is_refused_by_the_client) {
  RawServer server;
  const Answering answering(server, [](RawServer& s) {
    WelcomeMessage welcome;
    welcome.protocol = protocol_version + 1;
    s.send(welcome);
  });
  EXPECT_TRUE(holds(failure(server.port()), "the server speaks protocol " +
                                                std::to_string(protocol_version + 1) + ", this client " +
                                                std::to_string(protocol_version)));
}

TEST(Connection, messages_pass_both_ways_in_order_and_are_counted) {
  RawServer server;
  const auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  for (uint32_t i = 0; i < 100; ++i) server.send(ReplyMessage{i, "", 0});
  const std::vector<Received> got = wait_for(*connection, 100);
  ASSERT_EQ(got.size(), 100U);
  uint64_t bytes = encode(ServerMessage{WelcomeMessage{}}).size();
  for (uint32_t i = 0; i < 100; ++i) {
    EXPECT_EQ(std::get<ReplyMessage>(got[i].message).request, i);
    bytes += got[i].bytes;
  }
  EXPECT_EQ(connection->counters().received_bytes, bytes);

  for (Tick tick = 1; tick <= 100; ++tick) connection->send(AckMessage{tick});
  for (Tick tick = 1; tick <= 100; ++tick) {
    const auto message = server.receive();
    ASSERT_TRUE(message);
    EXPECT_EQ(std::get<AckMessage>(*message).tick, tick);
  }
  EXPECT_EQ(connection->counters().sent_messages, 101U) << "the hello is one, too";
}

TEST(Connection, a_server_that_falls_silent_after_its_frames_counts_as_lost) {
  RawServer server;
  const Answering answering(server, [](RawServer& s) {
    s.send(WelcomeMessage{});
    FrameMessage frame;
    frame.tick = 1;
    s.send(frame);
  });
  ServerEndpoint endpoint;
  endpoint.port = server.port();
  endpoint.silent_seconds_max = 0.2;
  const auto connection = Connection::connect(endpoint, {}, deadline);
  ASSERT_TRUE(connection);
  while ((*connection)->connected()) (*connection)->wait(std::chrono::milliseconds(50));
  EXPECT_TRUE(holds((*connection)->end().message, "the server has been silent"))
      << (*connection)->end().message;
}

TEST(Connection, a_link_that_never_delivers_is_given_up_at_the_deadline_and_not_before) {
  RawServer server;
  ServerEndpoint endpoint;
  endpoint.port = server.port();
  endpoint.link = *read_link("half-open=0");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(Connection::connect(endpoint, {}, std::chrono::milliseconds(100)));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(100));
}

TEST(Connection, an_end_by_the_server_is_told_and_what_came_before_can_be_polled) {
  RawServer server;
  const auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  server.send(ReplyMessage{7, "", 0});
  server.send(RefusalMessage{"the server stops"});
  server.hang_up();
  const std::vector<Received> got = wait_for(*connection, 1);
  wait_for_close(*connection);
  EXPECT_EQ(got.size(), 1U);
  EXPECT_EQ(connection->close_reason(), "the server refused: the server stops");
  connection->send(AckMessage{1});  // harmless
}

TEST(Connection, an_oversized_length_ends_the_connection_by_name) {
  RawServer server;
  const auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  server.send_bytes(std::vector<uint8_t>{0xFF, 0xFF, 0xFF, 0x7F});
  wait_for_close(*connection);
  EXPECT_TRUE(holds(connection->close_reason(), "over the limit of")) << connection->close_reason();
}

TEST(Connection, a_client_that_does_not_poll_stops_reading_and_loses_nothing) {
  RawServer server;
  const auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  constexpr size_t count = 3 * limits::received_messages_max;
  const ReplyMessage reply{1, std::string(limits::reason_bytes_max, 'x'), 0};
  std::thread sender([&] { server.send_until_stuck(reply, count, 10000); });
  const auto end = std::chrono::steady_clock::now() + deadline;
  while (connection->counters().pauses == 0 && std::chrono::steady_clock::now() < end) wait_a_moment();
  EXPECT_EQ(connection->counters().waiting_messages, limits::received_messages_max);
  EXPECT_EQ(wait_for(*connection, count).size(), count);
  sender.join();
}

TEST(Connection, a_client_that_does_not_poll_holds_no_more_than_its_limit_of_memory) {
  RawServer server;
  const auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  ChunkMessage chunk;  // a few bytes on the wire, many once it is decoded
  constexpr int bricks = chunk_bricks * chunk_bricks * chunk_bricks;
  for (int i = 0; i < bricks; ++i) chunk.bricks.push_back({brick_in_chunk(chunk.chunk, i), air_brick()});
  constexpr size_t memory_min = bricks * sizeof(Brick);
  constexpr size_t count = 3 * limits::received_bytes_max / memory_min;
  static_assert(count < limits::received_messages_max, "the bytes are to be what stops it");
  std::thread sender([&] { server.send_until_stuck(chunk, count, 10000); });
  const auto end = std::chrono::steady_clock::now() + deadline;
  const auto arrived = [&] {
    const ConnectionCounters counters = connection->counters();
    return counters.pauses != 0 || counters.waiting_messages == count;
  };
  while (!arrived() && std::chrono::steady_clock::now() < end) wait_a_moment();
  const ConnectionCounters counters = connection->counters();
  EXPECT_GE(counters.waiting_bytes, limits::received_bytes_max);
  EXPECT_LE(counters.waiting_bytes, limits::received_bytes_max + 2 * memory_min);
  EXPECT_EQ(counters.pauses, 1U);
  EXPECT_EQ(wait_for(*connection, count).size(), count);
  sender.join();
}

TEST(Connection, a_client_that_pauses_reading_is_stuck_until_it_goes_on) {
  RawServer server;
  const auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  connection->pause_reading(true);
  const ReplyMessage reply{1, std::string(limits::reason_bytes_max, 'x'), 0};
  const size_t sent = server.send_until_stuck(reply, 100000, 200);
  EXPECT_LT(sent, 100000U) << "the socket's buffers are all that takes bytes now";
  connection->pause_reading(false);
  EXPECT_GE(wait_for(*connection, sent).size(), sent);
}

TEST(Connection, a_server_that_does_not_read_is_given_up) {
  RawServer server;
  const auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  CarveMessage carve;
  carve.pattern = SeedPattern::authored;
  carve.authored_m.resize(limits::authored_seeds_max);
  carve.seeds = limits::authored_seeds_max;
  // Many times what the sockets' buffers take.
  const size_t bytes = encode(ClientMessage(carve)).size();
  for (size_t sent = 0; sent < 64 * limits::unsent_bytes_max && connection->connected(); sent += bytes)
    connection->send(carve);
  wait_for_close(*connection);
  EXPECT_TRUE(holds(connection->close_reason(), "limits.unsent_bytes_max")) << connection->close_reason();
}

TEST(Connection, a_cut_is_seen_at_both_ends) {
  RawServer server;
  const auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  connection->abort();
  wait_for_close(*connection);
  EXPECT_EQ(connection->close_reason(), "cut here");
  EXPECT_FALSE(server.receive());
}

TEST(Connection, goodbye_is_said_by_who_leaves_and_by_nobody_else) {
  RawServer server;
  auto connection = welcomed(server);
  ASSERT_TRUE(connection);
  connection->send(AckMessage{1});
  connection->leave();
  EXPECT_TRUE(server.receive()) << "what was sent before";
  const auto last = server.receive();
  ASSERT_TRUE(last);
  EXPECT_TRUE(std::holds_alternative<GoodbyeMessage>(*last));
  EXPECT_FALSE(server.receive());
  wait_for_close(*connection);
  connection->leave();  // harmless

  RawServer other;
  connection = welcomed(other);
  ASSERT_TRUE(connection);
  connection.reset();
  EXPECT_FALSE(other.receive()) << "it may come again";
}

}  // namespace
}  // namespace scree
