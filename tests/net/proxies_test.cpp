// Whose word counts for a client's address.
#include "server/doors/proxies.h"

#include <gtest/gtest.h>

#include "server/doors/door.h"

namespace scree {
namespace {

TEST(Proxies, are_networks_of_both_kinds) {
  const auto proxies = Proxies::parse({"10.0.0.0/8", "192.0.2.7", "172.16.0.0/12", "2001:db8:1::/48", "::1"});
  ASSERT_TRUE(proxies) << proxies.error().message;
  for (const char* one : {"10.255.0.1", "::ffff:10.0.0.1", "192.0.2.7", "172.16.0.1", "172.31.255.255",
                          "2001:db8:1:ffff::7", "::1"})
    EXPECT_TRUE(proxies->contains(one)) << one;
  for (const char* one :
       {"11.0.0.1", "192.0.2.8", "172.32.0.0", "172.15.255.255", "2001:db8:2::7", "127.0.0.1", "unknown", ""})
    EXPECT_FALSE(proxies->contains(one)) << one;
  EXPECT_FALSE(Proxies().contains("127.0.0.1"));
  EXPECT_TRUE(Proxies::parse({"::ffff:10.0.0.0/104"})->contains("10.1.2.3"));
  EXPECT_TRUE(Proxies::parse({"::/8"})->contains("::2"));
  EXPECT_FALSE(Proxies::parse({"::/8"})->contains("203.0.113.1")) << "IPv4 is a kind of its own";
  EXPECT_TRUE(Proxies::parse({"0.0.0.0/0"})->contains("203.0.113.1"));
  for (const char* wrong : {"10.0.0.0/33", "10.0.0.0/-1", "10.0.0.0/", "proxy.example", "", "::/129",
                            "10.0.0.0/8/8", "::ffff:10.0.0.1/32"})
    EXPECT_FALSE(Proxies::parse({wrong})) << wrong;
}

TEST(Proxies, name_the_rightmost_address_that_is_not_theirs) {
  const Proxies proxies = *Proxies::parse({"127.0.0.1", "10.0.0.0/8"});
  const auto client = [&](const char* list) { return proxies.client_of(list, "127.0.0.1"); };
  EXPECT_EQ(client("203.0.113.7"), "203.0.113.7");
  EXPECT_EQ(client("198.51.100.1, 203.0.113.7"), "203.0.113.7")
      << "what stands before it anybody may have written";
  EXPECT_EQ(client("198.51.100.1,203.0.113.7 , 10.0.0.3"), "203.0.113.7");
  EXPECT_EQ(client("203.0.113.7:50000"), "203.0.113.7");
  EXPECT_EQ(client("[2001:db8::7]:50000, 10.0.0.3"), "2001:db8::7");
  EXPECT_EQ(client("2001:db8::7"), "2001:db8::7");
  EXPECT_EQ(client(""), "127.0.0.1");
  EXPECT_EQ(client("10.0.0.3"), "10.0.0.3") << "all are trusted: the leftmost";
  EXPECT_EQ(client("203.0.113.7, unknown"), "127.0.0.1") << "who hides says nothing of those before";
  EXPECT_EQ(client("203.0.113.7, , 10.0.0.3"), "10.0.0.3");
  EXPECT_EQ(proxies.client_of("203.0.113.7", "192.0.2.1"), "192.0.2.1") << "who is not trusted is not asked";
}

TEST(Proxies, bring_nobody_who_counts_as_this_machine) {
  EXPECT_EQ(relayed_address("203.0.113.7"), door_address("203.0.113.7"));
  EXPECT_NE(relayed_address("127.0.0.1"), door_address("127.0.0.1"));
  EXPECT_FALSE(Door(Door::Rules{}).is_free(relayed_address("::1")));
}

}  // namespace
}  // namespace scree
