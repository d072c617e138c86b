// Tickets: for one use, for one session, for a minute, and for so many sessions.
#include "server/doors/tickets.h"

#include <gtest/gtest.h>
#include <set>
#include <vector>

#include "server/doors/limits.h"

namespace scree {
namespace {

Departed departed(uint64_t session, double at_s, bool reserves_place = false) {
  const std::string ip = "10.0.0." + std::to_string(session % 256);
  return {session, {}, ip, Origin(ip), RateLimit(1.0, 1.0), 0.0, 0, at_s, reserves_place};
}

TEST(Tickets, a_ticket_is_its_sessions_until_the_next_is_issued) {
  Tickets tickets;
  const std::string first = tickets.issue(7);
  EXPECT_EQ(tickets.session_of(first), 7U);
  EXPECT_EQ(tickets.departed(7), nullptr) << "it is still connected";
  tickets.depart(departed(7, 10.0));
  ASSERT_NE(tickets.departed(7), nullptr);
  const std::string second = tickets.issue(7);
  EXPECT_EQ(tickets.session_of(first), std::nullopt);
  EXPECT_EQ(tickets.session_of(second), 7U);
  EXPECT_EQ(tickets.departed(7), nullptr);
}

TEST(Tickets, no_byte_of_a_ticket_may_differ_and_none_be_missing) {
  Tickets tickets;
  tickets.issue(6);
  const std::string ticket = tickets.issue(7);
  for (size_t i = 0; i < ticket.size(); ++i) {
    std::string other = ticket;
    other[i] = static_cast<char>(other[i] ^ 1);
    EXPECT_EQ(tickets.session_of(other), std::nullopt) << "byte " << i;
    EXPECT_EQ(tickets.session_of(ticket.substr(0, i)), std::nullopt);
  }
  EXPECT_EQ(tickets.session_of(ticket + "x"), std::nullopt);
}

TEST(Tickets, are_not_alike) {
  Tickets tickets;
  std::set<std::string> secrets;
  for (int i = 0; i < 1000; ++i) secrets.insert(tickets.issue(1).substr(8));
  EXPECT_EQ(secrets.size(), 1000U);
}

TEST(Tickets, hold_for_a_minute_after_the_connections_end) {
  Tickets tickets;
  const std::string ticket = tickets.issue(7);
  tickets.expire(1e9);
  EXPECT_EQ(tickets.session_of(ticket), 7U) << "a session that lasts has no time";
  tickets.depart(departed(7, 100.0));
  tickets.expire(100.0 + limits::ticket_seconds_max);
  EXPECT_EQ(tickets.session_of(ticket), 7U);
  tickets.expire(100.1 + limits::ticket_seconds_max);
  EXPECT_EQ(tickets.session_of(ticket), std::nullopt);
  EXPECT_EQ(tickets.departed(7), nullptr);
}

TEST(Tickets, of_too_many_departed_sessions_those_that_were_there_for_the_shortest_time_are_forgotten) {
  Tickets tickets;
  std::vector<std::string> all;
  for (uint64_t id = 0; id <= limits::departed_max; ++id) {
    all.push_back(tickets.issue(id));
    Departed one = departed(id, 1e6 - static_cast<double>(id));
    one.origin = Origin("203.0.113.7");
    tickets.depart(one);
  }
  EXPECT_EQ(tickets.session_of(all.back()), std::nullopt) << "it was there for the shortest time";
  EXPECT_EQ(tickets.session_of(all.front()), 0U);
  tickets.forget_departed([](const Departed& one) { return one.ip == "10.0.0.1"; });
  EXPECT_EQ(tickets.session_of(all[1]), std::nullopt);
  EXPECT_EQ(tickets.session_of(all[2]), 2U);
}

TEST(Tickets, who_comes_and_goes_voids_no_ticket_of_another_not_even_on_the_same_machine) {
  Tickets tickets;
  const std::string far = tickets.issue(1), near = tickets.issue(2);
  Departed one = departed(1, 1000.0), other = departed(2, 1000.0);
  one.origin = Origin("203.0.113.7");
  other.origin = Origin("loopback");
  tickets.depart(one);
  tickets.depart(other);
  for (uint64_t id = 3; id < 3 + 3 * limits::departed_max; ++id) {
    tickets.issue(id);
    Departed churn = departed(id, 1001.0);
    churn.origin = Origin("loopback");
    churn.joined_s = 1000.99;
    tickets.depart(churn);
  }
  EXPECT_EQ(tickets.session_of(far), 1U);
  EXPECT_EQ(tickets.session_of(near), 2U);
}

TEST(Tickets, the_place_of_a_lost_connection_is_kept_for_a_while) {
  Tickets tickets;
  for (uint64_t id = 1; id <= 3; ++id) {
    tickets.issue(id);
    tickets.depart(departed(id, 100.0, id != 2));
  }
  EXPECT_EQ(tickets.reserved_places(100.0), 2U);
  EXPECT_EQ(tickets.reserved_places(100.1 + limits::place_kept_seconds_max), 0U);
  tickets.forget(1);
  EXPECT_EQ(tickets.reserved_places(100.0), 1U);
}

TEST(Tickets, tell_once_of_each_session_that_cannot_go_on) {
  std::vector<uint64_t> over;
  Tickets tickets([&](uint64_t session) { over.push_back(session); });
  for (const uint64_t id : {1U, 2U, 3U}) tickets.issue(id);
  tickets.issue(1);
  tickets.depart(departed(1, 100.0));
  tickets.depart(departed(2, 150.0));
  tickets.issue(2);  // it goes on
  EXPECT_TRUE(over.empty());
  tickets.expire(101.0 + limits::ticket_seconds_max);
  EXPECT_EQ(over, std::vector<uint64_t>{1});
  tickets.forget(3);
  tickets.forget(3);
  tickets.forget(77);  // never had one
  tickets.depart(departed(2, 200.0));
  tickets.forget_departed([](const Departed&) { return true; });
  EXPECT_EQ(over, (std::vector<uint64_t>{1, 3, 2}));
}

}  // namespace
}  // namespace scree
