#include "server/doors/door.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "server/doors/limits.h"
#include "shared/base/log_limit.h"

namespace scree {
namespace {

constexpr Door::Rules rules{2, 1.0, 3.0, true};

TEST(Door, an_address_is_a_machine_or_what_one_customer_is_given) {
  EXPECT_EQ(door_address("203.0.113.7"), "203.0.113.7");
  EXPECT_EQ(door_address("::ffff:203.0.113.7"), "203.0.113.7");
  EXPECT_EQ(door_address("2001:db8:1:2::1"), door_address("2001:db8:1:2:ffff::9"));
  EXPECT_NE(door_address("2001:db8:1:2::1"), door_address("2001:db8:1:3::1"));
  EXPECT_EQ(door_address("127.0.0.1"), door_address("::1"));
  EXPECT_EQ(door_address("127.8.9.1"), door_address("::ffff:127.0.0.1"));
}

TEST(Door, connections_are_bounded_in_number_and_in_rate_for_each_address_alone) {
  Door door(rules);
  EXPECT_EQ(door.enter("a", 0.0), std::nullopt);
  EXPECT_EQ(door.enter("a", 0.0), std::nullopt);
  EXPECT_EQ(door.enter("a", 0.0), Refusal::connections_per_address);
  EXPECT_EQ(door.enter("a", 0.0), Refusal::connects_per_second);
  EXPECT_EQ(door.enter("b", 0.0), std::nullopt);
  door.leave("a", 0.5);
  EXPECT_EQ(door.enter("a", 0.5), Refusal::connects_per_second);
  EXPECT_EQ(door.enter("a", 1.5), std::nullopt);
}

TEST(Door, a_site_of_ipv6_has_what_a_few_addresses_have_and_its_neighbours_have_theirs) {
  Door door(rules);
  const auto enter_from = [&](const std::string& prefix) {
    size_t entered = 0;
    for (int i = 0; i < 64; ++i)
      entered += door.enter(door_address(prefix + fmt::format("{:02x}::1", i)), 0.0) ? 0U : 1U;
    return entered;
  };
  EXPECT_EQ(enter_from("2001:db8:1:1"), limits::addresses_of_a_site * rules.connections_max);
  EXPECT_EQ(enter_from("2001:db8:1:2"), limits::addresses_of_a_site * rules.connections_max);
  EXPECT_EQ(enter_from("2001:db8:1:3"), limits::addresses_of_a_site * rules.connections_max);
  EXPECT_EQ(enter_from("2001:db8:1:4"), limits::addresses_of_a_site * rules.connections_max);
  EXPECT_EQ(enter_from("2001:db8:1:5"), 0U) << "its /48 is full";
  EXPECT_EQ(enter_from("2001:db8:2:1"), limits::addresses_of_a_site * rules.connections_max);
  for (int i = 0; i < 8; ++i) door.leave(door_address(fmt::format("2001:db8:1:1{:02x}::1", i)), 100.0);
  EXPECT_EQ(door.enter(door_address("2001:db8:1:500::1"), 100.0), std::nullopt);
}

TEST(Door, this_machine_is_free_unless_told_otherwise) {
  const std::string here = door_address("127.0.0.1");
  Door door(rules), strict({2, 1.0, 3.0, false});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(door.enter(here, 0.0), std::nullopt);
  for (int i = 0; i < 3; ++i) static_cast<void>(strict.enter(here, 0.0));
  EXPECT_TRUE(strict.enter(here, 0.0).has_value());
}

TEST(Door, a_connection_that_turns_out_to_be_anothers_needs_a_place_there_and_comes_but_once) {
  const std::string here = door_address("127.0.0.1"), strangers = relayed_address("127.0.0.1");
  EXPECT_FALSE(Door(rules).is_free(strangers));
  Door door(rules);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(door.enter(here, 0.0), std::nullopt);
  EXPECT_EQ(door.move(here, strangers, 0.0), std::nullopt);
  EXPECT_EQ(door.move(here, strangers, 0.0), std::nullopt);
  EXPECT_EQ(door.move(here, strangers, 0.0), Refusal::connections_per_address);
  door.leave(strangers, 0.0);
  EXPECT_EQ(door.move(here, strangers, 0.0), std::nullopt) << "however many came in this second";
  door.share_loopback();
  EXPECT_FALSE(door.is_free(here));
  EXPECT_EQ(door.enter(here, 0.0), Refusal::connections_per_address);
}

TEST(Door, each_wrong_guess_makes_the_next_wait_longer_up_to_a_bound_and_only_there) {
  Door door(rules);
  double now_s = 100.0, wait_s = 0.0;
  for (int i = 0; i < 10; ++i) {
    door.guessed_wrong("a", "guess " + std::to_string(i), now_s);
    EXPECT_GE(door.wait_for_guess_s("a", now_s), wait_s);
    wait_s = door.wait_for_guess_s("a", now_s);
    if (i < 2) {
      EXPECT_EQ(wait_s, (1.0 + i) * limits::guess_wait_min_s);
    }
    now_s += wait_s;
    EXPECT_LE(door.wait_for_guess_s("a", now_s), 0.0);
  }
  EXPECT_EQ(wait_s, limits::guess_wait_max_s);
  EXPECT_EQ(door.wait_for_guess_s("b", now_s), 0.0);
  door.guessed_wrong("a", "guess", now_s + 2.0 * limits::door_memory_s);
  EXPECT_EQ(door.wait_for_guess_s("a", now_s + 2.0 * limits::door_memory_s), limits::guess_wait_min_s)
      << "it is forgiven in the end";
}

TEST(Door, the_last_wrong_tokens_of_an_address_are_known_again_there) {
  Door door(rules);
  for (size_t i = 0; i <= limits::wrong_tokens_known; ++i) door.guessed_wrong("a", std::to_string(i), 0.0);
  EXPECT_FALSE(door.knows_as_wrong("a", "0")) << "the oldest is forgotten";
  EXPECT_TRUE(door.knows_as_wrong("a", "1"));
  EXPECT_FALSE(door.knows_as_wrong("b", "1"));
}

TEST(Door, addresses_are_bounded_and_those_with_connections_are_kept) {
  Door door(rules);
  EXPECT_EQ(door.enter("stays", 0.0), std::nullopt);
  for (size_t i = 0; i < 2 * limits::door_addresses_max; ++i) {
    const std::string address = std::to_string(i);
    EXPECT_EQ(door.enter(address, 1.0), std::nullopt);
    door.leave(address, 1.0);
  }
  EXPECT_LE(door.addresses(), limits::door_addresses_max);
  door.leave("stays", 2.0);
}

TEST(Door, addresses_that_guess_are_bounded_too_and_forgotten_after_those_that_do_not) {
  Door door(rules);
  EXPECT_EQ(door.enter("guesses", 0.0), std::nullopt);
  door.guessed_wrong("guesses", "token", 1.0);
  door.leave("guesses", 1.0);
  for (size_t i = 0; i < limits::door_addresses_max; ++i) {
    const std::string address = std::to_string(i);
    EXPECT_EQ(door.enter(address, 1.0), std::nullopt);
    door.leave(address, 1.0);
  }
  EXPECT_GT(door.wait_for_guess_s("guesses", 1.0), 0.0) << "it cannot be made to be forgotten so";
  for (size_t i = 0; i < 2 * limits::door_addresses_max; ++i) {
    const std::string address = "wrong " + std::to_string(i);
    EXPECT_EQ(door.enter(address, 2.0), std::nullopt);
    door.guessed_wrong(address, "token", 2.0);
    door.leave(address, 2.0);
  }
  EXPECT_LE(door.addresses(), limits::door_addresses_max);
}

TEST(LogLimit, a_few_lines_of_each_kind_and_the_count_of_the_rest) {
  LogLimit log;
  int written = 0;
  for (int i = 0; i < 1000; ++i) written += log.admit("one", 0.0) ? 1 : 0;
  EXPECT_EQ(written, static_cast<int>(limits::log_lines_burst));
  EXPECT_EQ(log.admit("other", 0.0), std::string());
  EXPECT_EQ(log.admit("one", 1.0), " (and " + std::to_string(1000 - written) + " more like this)");
  EXPECT_EQ(log.admit("one", 1.0), std::string());
}

}  // namespace
}  // namespace scree
