// A TCP stream: how it says that it ended, in order or not; and what waits in it.
#include "transport/tcp_transport.h"

#include <array>
#include <asio/connect.hpp>
#include <asio/io_context.hpp>
#include <gtest/gtest.h>
#include <optional>

#include "tests/support/raw_client.h"

namespace scree {
namespace {

/// Two ends on loopback; nothing happens on either but what the test asks for.
struct TcpPair {
  asio::io_context context;
  std::shared_ptr<TcpTransport> here, there;
  std::array<uint8_t, 64> buffer{};
  std::optional<Moved> read;

  TcpPair() {
    asio::ip::tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
    asio::ip::tcp::socket near(context);
    near.connect(acceptor.local_endpoint());
    here = std::make_shared<TcpTransport>(std::move(near));
    there = std::make_shared<TcpTransport>(acceptor.accept());
  }
  size_t write_now() {
    static constexpr std::array<uint8_t, 3> bytes{1, 2, 3};
    const std::span<const uint8_t> all(bytes);
    return here->write_now({&all, 1});
  }
  const Moved& next_read() {
    read.reset();
    here->read_some(buffer, [this](const Moved& moved) { read = moved; });
    context.restart();
    while (!read) context.run_one();
    return *read;
  }
};

TEST(TcpTransports, that_the_other_side_finished_ended_in_order) {
  TcpPair pair;
  EXPECT_EQ(pair.write_now(), 3U);
  pair.there->finish_sending();
  const Moved& end = pair.next_read();
  ASSERT_FALSE(end);
  EXPECT_TRUE(end.error().orderly);
}

TEST(TcpTransports, that_were_reset_say_so_to_the_reader_though_a_write_met_the_reset_first) {
  for (const bool writes_first : {false, true}) {
    TcpPair pair;
    pair.there->abort();
    if (writes_first) {
      EXPECT_EQ(pair.write_now(), 0U);
    }
    const Moved& end = pair.next_read();
    ASSERT_FALSE(end);
    EXPECT_FALSE(end.error().orderly) << end.error().why;
    EXPECT_EQ(end.error().why, "Connection reset by peer");
  }
}

TEST(TcpTransports, give_out_what_came_before_the_reset) {
  TcpPair pair;
  const std::array<uint8_t, 4> goodbye{4, 3, 2, 1};
  const std::span<const uint8_t> all(goodbye);
  EXPECT_EQ(pair.there->write_now({&all, 1}), goodbye.size());
  EXPECT_EQ(pair.write_now(), 3U);  // unread by the other side: its end is a reset
  pair.there->close();
  EXPECT_EQ(pair.next_read().value_or(0), goodbye.size());
  EXPECT_FALSE(pair.next_read());
}

TEST(TcpTransports, tell_of_no_bytes_once_they_are_closed) {
  TcpPair pair;
  EXPECT_EQ(pair.write_now(), 3U);
  std::optional<Moved> read;
  pair.there->read_some(pair.buffer,
                        [&](const Moved& moved) { read = moved; });  // the bytes are there already
  pair.there->close();
  pair.context.restart();
  pair.context.run();
  ASSERT_TRUE(read);
  EXPECT_FALSE(*read);
}

TEST(TcpTransports, tells_how_much_waits_here_for_a_client_that_does_not_read) {
  asio::io_context context;
  asio::ip::tcp::acceptor acceptor(context, {asio::ip::address_v4::loopback(), 0});
  RawClient client(acceptor.local_endpoint().port(), 4096);
  ASSERT_TRUE(client.connected());
  const auto transport = std::make_shared<TcpTransport>(acceptor.accept());
  EXPECT_EQ(transport->unsent_bytes(), 0U);
  const std::vector<uint8_t> bytes(size_t{64} << 10U);
  const std::span<const uint8_t> all(bytes);
  size_t taken = 0;
  while (const size_t more = transport->write_now({&all, 1})) taken += more;
  EXPECT_GT(transport->unsent_bytes(), taken / 2);
  EXPECT_LE(transport->unsent_bytes(), taken);
}

}  // namespace
}  // namespace scree
