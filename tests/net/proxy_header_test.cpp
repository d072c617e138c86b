// The header by which a proxy names its client, read from bytes that anybody may send; and the stream behind
// it, cut anywhere.
#include "transport/proxy_header.h"

#include <gtest/gtest.h>
#include <string>

#include "tests/fuzz/support/memory_transport.h"
#include "tests/support/materials.h"
#include "transport/proxied_transport.h"

namespace scree {
namespace {

std::vector<uint8_t> bytes_of_text(const std::string& text) {
  return {text.begin(), text.end()};
}

/// Version 2, of a client by TCP over IPv4 or IPv6.
std::vector<uint8_t> binary_header(uint8_t command, uint8_t family, const std::vector<uint8_t>& addresses) {
  std::vector<uint8_t> header = bytes_of_text(std::string("\r\n\r\n\0\r\nQUIT\n", 12));
  header.insert(header.end(), {command, family, static_cast<uint8_t>(addresses.size() >> 8U),
                               static_cast<uint8_t>(addresses.size())});
  header.insert(header.end(), addresses.begin(), addresses.end());
  return header;
}

const std::vector<uint8_t> v4_addresses{203, 0, 113, 7, 192, 0, 2, 1, 0xC3, 0x50, 0x10, 0x51};

struct NamedHeader {
  std::string name;
  std::vector<uint8_t> bytes;
  std::string address;
  uint16_t port;
};

std::vector<NamedHeader> good_headers() {
  std::vector<uint8_t> v6(36);
  v6[0] = 0x20, v6[1] = 0x01, v6[2] = 0x0d, v6[3] = 0xb8, v6[15] = 7, v6[32] = 0xC3, v6[33] = 0x50;
  std::vector<uint8_t> with_extension = v4_addresses;
  with_extension.insert(with_extension.end(), {0x04, 0x00, 0x02, 0xAA, 0xBB});
  return {
      {"text 4", bytes_of_text("PROXY TCP4 203.0.113.7 192.0.2.1 50000 4177\r\n"), "203.0.113.7", 50000},
      {"text 6", bytes_of_text("PROXY TCP6 2001:db8::7 2001:db8::1 50000 4177\r\n"), "2001:db8::7", 50000},
      {"text unknown", bytes_of_text("PROXY UNKNOWN\r\n"), "", 0},
      {"text unknown with words", bytes_of_text("PROXY UNKNOWN a b c d\r\n"), "", 0},
      {"binary 4", binary_header(0x21, 0x11, v4_addresses), "203.0.113.7", 50000},
      {"binary 6", binary_header(0x21, 0x21, v6), "2001:db8::7", 50000},
      {"binary with extension", binary_header(0x21, 0x11, with_extension), "203.0.113.7", 50000},
      {"binary local", binary_header(0x20, 0x00, {}), "", 0},
      {"binary without family", binary_header(0x21, 0x00, {}), "", 0}};
}

TEST(ProxyHeader, names_the_client_and_is_not_read_before_it_is_whole) {
  for (const auto& [name, bytes, address, port] : good_headers()) {
    for (size_t count = 0; count < bytes.size(); ++count) {
      const auto part = read_proxy_header(std::span(bytes).first(count));
      ASSERT_TRUE(part.has_value()) << name;
      EXPECT_FALSE(part->has_value()) << name << " after " << count;
    }
    std::vector<uint8_t> more = bytes;
    more.insert(more.end(), {'G', 'E', 'T'});
    const auto header = read_proxy_header(more);
    ASSERT_TRUE(header && *header) << name;
    EXPECT_EQ((*header)->bytes, bytes.size()) << name;
    EXPECT_EQ((*header)->address, address) << name;
    EXPECT_EQ((*header)->port, port) << name;
  }
}

TEST(ProxyHeader, is_none_where_the_bytes_begin_otherwise) {
  for (const std::string& text :
       {std::string("GET / HTTP/1.1"), std::string("PROXX"), std::string("\x05\0\0\0", 4),
        std::string("\r\n\r\nGET"), std::string("\x16\x03\x01")}) {
    const auto header = read_proxy_header(bytes_of_text(text));
    ASSERT_TRUE(header && *header) << text;
    EXPECT_EQ((*header)->bytes, 0U) << text;
  }
}

TEST(ProxyHeader, is_refused_where_it_breaks_the_rules) {
  for (const std::string& text :
       {std::string("PROXY TCP4 203.0.113.7 192.0.2.1 50000\r\n"),
        std::string("PROXY TCP4 2001:db8::7 192.0.2.1 50000 1\r\n"),
        std::string("PROXY TCP6 203.0.113.7 192.0.2.1 50000 1\r\n"),
        std::string("PROXY TCP4 203.0.113.7 192.0.2.1 65536 1\r\n"),
        std::string("PROXY TCP4 203.0.113.7 192.0.2.1 -1 1\r\n"), std::string("PROXY \r\n"),
        std::string("PROXY UDP4 203.0.113.7 192.0.2.1 1 1\r\n"), "PROXY TCP4 " + std::string(200, '1')})
    EXPECT_FALSE(read_proxy_header(bytes_of_text(text))) << text;
  EXPECT_FALSE(read_proxy_header(binary_header(0x31, 0x11, v4_addresses))) << "version 3";
  EXPECT_FALSE(read_proxy_header(binary_header(0x22, 0x11, v4_addresses))) << "command 2";
  EXPECT_FALSE(read_proxy_header(binary_header(0x21, 0x21, v4_addresses))) << "too short for IPv6";
  std::vector<uint8_t> endless = binary_header(0x21, 0x11, v4_addresses);
  endless[14] = endless[15] = 0xFF;
  EXPECT_FALSE(read_proxy_header(endless));
}

/// What a stream delivers, read a few bytes at a time.
struct Reading {
  explicit Reading(std::shared_ptr<Transport> from) : stream(std::move(from)) { read(); }
  void read() {
    stream->read_some(buffer, [this](const Moved& moved) {
      if (!moved) return void(end = moved.error());
      text.append(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*moved));
      read();
    });
  }
  std::shared_ptr<Transport> stream;
  std::array<uint8_t, 5> buffer{};
  std::string text;
  std::optional<StreamEnd> end;
};

TEST(ProxiedTransport, delivers_what_stands_behind_the_header_and_has_its_address) {
  for (const auto& [name, bytes, address, port] : good_headers())
    for (const size_t step : {size_t{1}, size_t{7}, size_t{1000}}) {
      const auto link = std::make_shared<MemoryTransport>("10.0.0.1");
      std::string named;
      const auto stream = std::make_shared<ProxiedTransport>(
          link, [&](const ProxiedTransport& from) { named = from.address(); });
      Reading reading(stream);
      link->send(bytes);
      link->send(bytes_of_text("the bytes of the client"));
      link->end(true);
      while (link->pump(step)) continue;
      EXPECT_EQ(reading.text, "the bytes of the client") << name << " by " << step;
      EXPECT_EQ(named, address) << name;
      EXPECT_EQ(stream->address(), address.empty() ? "10.0.0.1" : address) << name;
      EXPECT_EQ(stream->port(), address.empty() ? 1 : port) << name;
      ASSERT_TRUE(reading.end);
      EXPECT_TRUE(reading.end->orderly);
    }
}

TEST(ProxiedTransport, delivers_all_where_no_header_comes_and_the_end_where_one_is_broken) {
  const auto all_of = [](const std::string& sent) {
    const auto link = std::make_shared<MemoryTransport>("10.0.0.1");
    Reading reading(std::make_shared<ProxiedTransport>(link, [](const ProxiedTransport&) { ADD_FAILURE(); }));
    link->send(bytes_of_text(sent));
    link->end(true);
    while (link->pump(1)) continue;
    EXPECT_TRUE(reading.end);
    return std::pair(reading.text, reading.end->broken);
  };
  EXPECT_EQ(all_of("GET / HTTP/1.1"), std::pair(std::string("GET / HTTP/1.1"), false));
  EXPECT_EQ(all_of("PROX"), std::pair(std::string("PROX"), false)) << "it ended before anybody could tell";
  EXPECT_EQ(all_of("PROXY nonsense\r\nGET /"), std::pair(std::string(), true));
}

}  // namespace
}  // namespace scree
