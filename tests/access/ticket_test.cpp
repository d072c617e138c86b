// Sessions that go on by a ticket over loopback, and tickets that must not: reused, foreign, after a kick, a
// ban, or the end of the token.
#include <fstream>
#include <gtest/gtest.h>

#include "tests/support/access_fixture.h"
#include "tests/support/holds.h"
#include "tests/support/patience.h"

namespace scree {
namespace {

class TicketTest : public AccessTest {
 protected:
  struct Joined {
    std::unique_ptr<RawClient> client;
    WelcomeMessage welcome;
  };
  Joined come(const std::string& token, const std::string& ticket = "") {
    Joined joined{std::make_unique<RawClient>(server->port()), {}};
    HelloMessage with_ticket = hello(token);
    with_ticket.ticket = ticket;
    EXPECT_TRUE(joined.client->send(with_ticket));
    const auto welcome = joined.client->receive_as<WelcomeMessage>();
    EXPECT_TRUE(welcome);
    if (welcome) joined.welcome = *welcome;
    return joined;
  }
  void leave(Joined& joined) {
    const uint32_t before = server->stats().sessions;
    joined.client.reset();
    const auto end = std::chrono::steady_clock::now() + patience;
    while (server->stats().sessions == before && std::chrono::steady_clock::now() < end) wait_a_moment();
  }
  void expect_fresh(const Joined& joined, const Joined& before) {
    EXPECT_FALSE(joined.welcome.resumed);
    EXPECT_NE(joined.welcome.session, before.welcome.session);
  }
  uint64_t tickets_void() const { return server->stats().tickets_void; }
};

TEST_F(TicketTest, the_session_goes_on_with_its_number_role_and_name) {
  start();
  Joined first = come(token(Role::builder));
  EXPECT_FALSE(first.welcome.resumed);
  EXPECT_NE(first.welcome.world, 0U);
  leave(first);
  const Joined second = come(token(Role::builder), first.welcome.ticket);
  EXPECT_TRUE(second.welcome.resumed);
  EXPECT_EQ(second.welcome.session, first.welcome.session);
  EXPECT_EQ(second.welcome.role, Role::builder);
  EXPECT_EQ(second.welcome.world, first.welcome.world);
  EXPECT_NE(second.welcome.ticket, first.welcome.ticket);
  ASSERT_TRUE(second.client->send(FillMessage{{sphere({}, 1.0F)}, 9}));
  const auto sessions = list_sessions(admin(the_admin_token));
  ASSERT_TRUE(sessions);
  EXPECT_EQ((*sessions)[0].session, first.welcome.session);
  EXPECT_EQ((*sessions)[0].name, "Ben");
  std::vector<Command> asked;
  const auto end = std::chrono::steady_clock::now() + patience;
  while (asked.empty() && std::chrono::steady_clock::now() < end) asked = commands.drain();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].session, first.welcome.session) << "his share of the world stays his";
  EXPECT_EQ(server->stats().sessions_resumed, 1U);
  EXPECT_EQ(tickets_void(), 0U);
}

TEST_F(TicketTest, a_connection_that_the_server_still_takes_for_alive_ends_for_the_new_one) {
  start();
  const Joined half_open = come("");
  const Joined again = come("", half_open.welcome.ticket);
  EXPECT_TRUE(again.welcome.resumed);
  EXPECT_EQ(again.welcome.session, half_open.welcome.session);
  EXPECT_TRUE(half_open.client->closed_within(patience));
  EXPECT_EQ(server->stats().sessions, 1U);
}

TEST_F(TicketTest, a_ticket_holds_once) {
  start();
  Joined first = come("");
  leave(first);
  Joined second = come("", first.welcome.ticket);
  const Joined thief = come("", first.welcome.ticket);
  expect_fresh(thief, first);
  EXPECT_EQ(tickets_void(), 1U);
  EXPECT_FALSE(second.client->closed_within(std::chrono::milliseconds(20))) << "nobody's but the thief's";
}

TEST_F(TicketTest, a_ticket_of_nobody_is_an_ordinary_join) {
  start();
  const Joined other = come("");
  for (const std::string& ticket :
       {std::string("x"), std::string(limits::ticket_bytes_max, 'x'), std::string(24, '\0')})
    expect_fresh(come("", ticket), other);
  EXPECT_EQ(tickets_void(), 3U);
  EXPECT_EQ(server->stats().sessions_refused, 0U);
}

TEST_F(TicketTest, with_another_token_or_without_it_is_no_way_into_the_session) {
  start();
  const Joined builder = come(token(Role::builder, 21));
  expect_fresh(come("", builder.welcome.ticket), builder);
  expect_fresh(come(token(Role::builder, 22), builder.welcome.ticket), builder);
  expect_fresh(come(token(Role::carver, 21), builder.welcome.ticket), builder);
  EXPECT_EQ(tickets_void(), 3U);
  EXPECT_FALSE(builder.client->closed_within(std::chrono::milliseconds(20)));
  EXPECT_TRUE(come(token(Role::builder, 21), builder.welcome.ticket).welcome.resumed)
      << "it still holds for him";
}

TEST_F(TicketTest, after_a_kick_it_does_not_hold_whether_he_was_there_or_not) {
  start();
  Joined there = come("");
  ASSERT_TRUE(kick_session(admin(the_admin_token), {there.welcome.session, ""}));
  EXPECT_TRUE(there.client->closed_within(patience));
  expect_fresh(come("", there.welcome.ticket), there);
  Joined gone = come("");
  leave(gone);
  ASSERT_TRUE(kick_session(admin(the_admin_token), {gone.welcome.session, ""}));
  expect_fresh(come("", gone.welcome.ticket), gone);
  EXPECT_EQ(tickets_void(), 2U);
}

TEST_F(TicketTest, nobody_outlives_a_ban_by_it) {
  start();
  Joined gone = come("");
  leave(gone);
  ASSERT_TRUE(ban_address(admin(the_admin_token), {gone.welcome.session, "", 0, ""}));
  HelloMessage back = hello("");
  back.ticket = gone.welcome.ticket;
  EXPECT_TRUE(holds(refusal(back), "is banned"));
  ASSERT_TRUE(lift_ban(admin(the_admin_token), {"127.0.0.1"}));
  expect_fresh(come("", gone.welcome.ticket), gone);
}

TEST_F(TicketTest, nor_the_end_of_his_token) {
  config.access.token_revoked_path = folder / "revoked";
  std::ofstream(folder / "revoked") << "";
  start();
  Joined gone = come(token(Role::builder, 21));
  leave(gone);
  std::ofstream(folder / "revoked") << id_text(21) << "\n";
  ASSERT_TRUE(server->reload());
  HelloMessage back = hello(token(Role::builder, 21));
  back.ticket = gone.welcome.ticket;
  EXPECT_TRUE(holds(refusal(back), "was revoked"));
  const Joined without = come("", gone.welcome.ticket);
  expect_fresh(without, gone);
  EXPECT_EQ(without.welcome.role, Role::viewer);
}

TEST_F(TicketTest, a_full_server_keeps_the_place_of_who_lost_his_connection) {
  config.service.sessions_max = 4;
  start();
  std::vector<Joined> others;
  for (int i = 0; i < 3; ++i) {
    others.push_back(come(""));
    ASSERT_TRUE(others.back().client->send(AckMessage{1}));
  }
  Joined lost = come("");
  lost.client->reset();
  leave(lost);
  EXPECT_TRUE(holds(refusal(hello("")), "the server is full"));
  const Joined holder = come(token(Role::viewer));
  EXPECT_NE(holder.welcome.session, 0U) << "who holds a token does not wait for him";
  leave(others[0]);
  const Joined back = come("", lost.welcome.ticket);
  EXPECT_TRUE(back.welcome.resumed);
}

TEST_F(TicketTest, who_says_goodbye_frees_his_place_at_once_and_does_not_go_on) {
  config.service.sessions_max = 4;
  start();
  std::vector<Joined> others;
  for (int i = 0; i < 3; ++i) {
    others.push_back(come(""));
    ASSERT_TRUE(others.back().client->send(AckMessage{1}));
  }
  Joined first = come("");
  ASSERT_TRUE(first.client->send(AckMessage{1}));
  first.client->finish_sending();  // an end in order, but no goodbye
  ASSERT_TRUE(first.client->closed_within(patience));
  EXPECT_TRUE(holds(refusal(hello("")), "the server is full")) << "his place is kept";
  Joined again = come("", first.welcome.ticket);
  EXPECT_TRUE(again.welcome.resumed);
  ASSERT_TRUE(again.client->send(GoodbyeMessage{}));
  ASSERT_TRUE(again.client->closed_within(patience));
  const Joined other = come("", again.welcome.ticket);
  expect_fresh(other, again);
  EXPECT_EQ(tickets_void(), 1U);
}

TEST_F(TicketTest, what_he_asked_for_waits_as_long_as_he_may_go_on) {
  start();
  const auto next_commands = [&] {
    std::vector<Command> asked;
    const auto end = std::chrono::steady_clock::now() + patience;
    while (asked.empty() && std::chrono::steady_clock::now() < end) asked = commands.drain();
    return asked;
  };
  const auto leaves = [](const std::vector<Command>& asked, uint64_t session) {
    return asked.size() == 1 && asked[0].session == session &&
           std::holds_alternative<LeaveRequest>(asked[0].body);
  };
  Joined asker = come(token(Role::builder));
  ASSERT_TRUE(asker.client->send(FillMessage{{sphere({}, 1.0F)}, 1}));
  ASSERT_EQ(next_commands().size(), 1U);
  leave(asker);
  EXPECT_TRUE(commands.drain().empty()) << "his connection is lost: he may come again";
  Joined again = come(token(Role::builder), asker.welcome.ticket);
  ASSERT_TRUE(again.welcome.resumed);
  ASSERT_TRUE(again.client->send(GoodbyeMessage{}));
  EXPECT_TRUE(leaves(next_commands(), asker.welcome.session));
  Joined lost = come(token(Role::builder));
  ASSERT_TRUE(lost.client->send(FillMessage{{sphere({}, 1.0F)}, 1}));
  ASSERT_EQ(next_commands().size(), 1U);
  leave(lost);
  ASSERT_TRUE(kick_session(admin(the_admin_token), {lost.welcome.session, ""}));
  EXPECT_TRUE(leaves(next_commands(), lost.welcome.session));
  const Joined silent = come(token(Role::builder));
  ASSERT_TRUE(silent.client->send(GoodbyeMessage{}));
  ASSERT_TRUE(silent.client->closed_within(patience));
  EXPECT_TRUE(commands.drain().empty()) << "he asked for nothing";
}

}  // namespace
}  // namespace scree
