// Connections that a trusted proxy brings, each with a header that names its client.
#include <gtest/gtest.h>

#include "tests/support/net_server_fixture.h"

namespace scree {
namespace {

class NamedClientTest : public NetServerTest {
 protected:
  void open() {
    start([](NetConfig& config) {
      config.proxies = *Proxies::parse({"127.0.0.1", "10.0.0.0/8"});
      config.door.connections_max = 1;
    });
  }
  /// A client that is at this address, by the proxy's word.
  std::unique_ptr<RawClient> come_from(const std::string& ip) {
    auto client = std::make_unique<RawClient>(server->port());
    const std::string header = "PROXY TCP4 " + ip + " 192.0.2.1 50000 4177\r\n";
    EXPECT_TRUE(
        client->send_bytes(std::span(reinterpret_cast<const uint8_t*>(header.data()), header.size())));
    EXPECT_TRUE(client->send(hello()));
    return client;
  }
};

TEST_F(NamedClientTest, each_address_has_its_own_places_and_no_more) {
  open();
  const auto first = come_from("203.0.113.7");
  EXPECT_TRUE(first->receive_as<WelcomeMessage>());
  const auto other = come_from("203.0.113.8");
  EXPECT_TRUE(other->receive_as<WelcomeMessage>());
  const auto second = come_from("203.0.113.7");
  expect_refused(*second, "connections-per-address");
  EXPECT_EQ(server->stats().turned_away, 1U);
}

TEST_F(NamedClientTest, another_trusted_proxy_speaks_for_many_too) {
  open();
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(come_from("10.0.0.3"));
    EXPECT_TRUE(clients.back()->receive_as<WelcomeMessage>()) << i;
  }
  EXPECT_EQ(server->stats().turned_away, 0U);
  expect_witness_unmoved();
}

}  // namespace
}  // namespace scree
