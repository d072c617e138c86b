// The table of sessions, and its neighbours: who gives way in a full server, who may come back, who is sent
// what is queued.
#include "server/net/session_table.h"

#include <fmt/format.h>
#include <functional>

#include "server/doors/limits.h"
#include "server/net/flush_queue.h"
#include "server/net/limits.h"
#include "server/net/returns.h"
#include "server/net/room.h"
#include "tests/support/memory_sessions.h"

namespace scree {
namespace {

const Grant viewer{.role = Role::viewer};

Grant holder(uint64_t token_id) {
  return {.role = Role::builder, .token_id = token_id};
}

TEST(SessionTable, a_session_is_an_outsider_until_it_joins_and_again_once_it_is_refused) {
  MemorySessions sessions;
  SessionTable& table = sessions.table;
  sessions.connect(1, "10.0.0.1");
  sessions.connect(2, "10.0.0.1");
  EXPECT_EQ(table.outsiders(), 2U);
  EXPECT_EQ(table.joined(), 0U);
  const auto joined = sessions.join(3, "10.0.0.1");
  EXPECT_EQ(table.joined(), 1U);
  EXPECT_EQ(table.rows(sessions.now_s).size(), 1U);
  joined->refuse({Refusal::kicked, "enough"});
  EXPECT_EQ(table.joined(), 0U);
  EXPECT_EQ(table.outsiders(), 3U);
  EXPECT_TRUE(table.rows(sessions.now_s).empty());
  joined->close("closed");
  EXPECT_EQ(table.outsiders(), 2U);
  EXPECT_EQ(table.find(3), nullptr);
}

TEST(SessionTable, a_client_that_says_it_was_relayed_is_charged_to_its_address) {
  MemorySessions sessions;
  const auto session = sessions.join(1, "203.0.113.7");
  SessionEntry& entry = sessions.table.at(1);
  entry.relayed = true;
  EXPECT_EQ(entry.receiver().address, session->address());
  entry.is_many = true;
  EXPECT_EQ(entry.receiver().address, "") << "a trusted proxy that names nobody";
}

TEST(SessionTable, a_session_that_goes_on_has_the_old_number) {
  MemorySessions sessions;
  const auto session = sessions.connect(5, "10.0.0.1");
  sessions.table.join(*session, 2);
  EXPECT_EQ(session->id(), 2U);
  EXPECT_EQ(sessions.table.at(2).session, session);
  EXPECT_EQ(sessions.table.find(5), nullptr);
  EXPECT_EQ(sessions.table.joined(), 1U);
}

TEST(SessionTable, a_new_request_rate_holds_for_sessions_that_are_there_and_that_come) {
  MemorySessions sessions;
  sessions.join(1, "10.0.0.1");
  sessions.table.set_requests_per_second(1.0);
  sessions.join(2, "10.0.0.1");
  for (const uint64_t id : {1, 2}) {
    size_t taken = 0;
    while (sessions.table.at(id).requests.try_spend(sessions.now_s)) ++taken;
    EXPECT_EQ(taken, static_cast<size_t>(limits::requests_burst_s)) << id;
  }
}

TEST(Room, those_without_a_token_give_way_first_then_the_idlest_and_administrators_never) {
  MemorySessions sessions;
  sessions.join(1, "10.0.0.1", {.role = Role::admin});
  sessions.join(2, "10.0.0.2", holder(7));
  sessions.join(3, "10.0.0.3", viewer);
  const auto newcomer = sessions.connect(9, "10.0.0.3");
  const auto gives_way = [&](const Grant& grant) -> uint64_t {
    const auto leaver = who_gives_way(sessions.table, newcomer->origin(), grant, sessions.now_s);
    return leaver ? leaver->session->id() : 0;
  };
  EXPECT_EQ(gives_way(viewer), 0U) << "all have just come";
  EXPECT_EQ(gives_way(holder(8)), 3U);
  sessions.now_s += limits::idle_seconds_max + 1.0;
  EXPECT_EQ(gives_way(viewer), 3U);
  sessions.table.at(3).session->close("gone");
  EXPECT_EQ(gives_way(viewer), 0U);
  EXPECT_EQ(gives_way(holder(8)), 2U);
  sessions.table.at(2).session->close("gone");
  EXPECT_EQ(gives_way(holder(8)), 0U);
}

TEST(Room, who_holds_a_token_and_acts_keeps_his_place_from_others_who_hold_one) {
  MemorySessions sessions;
  sessions.join(1, "10.0.0.1", holder(7));
  const auto newcomer = sessions.connect(9, "10.0.0.2");
  const auto gives_way = [&] {
    return who_gives_way(sessions.table, newcomer->origin(), holder(8), sessions.now_s).has_value();
  };
  EXPECT_FALSE(gives_way()) << "he has just come";
  sessions.now_s += limits::idle_seconds_max + 1.0;
  sessions.links[1]->send(encode(ClientMessage(InterestMessage{{1.0F, 2.0F, 3.0F}, 64.0F})));
  sessions.pump(1);
  EXPECT_FALSE(gives_way()) << "he has just acted";
  sessions.now_s += limits::idle_seconds_max + 1.0;
  EXPECT_TRUE(gives_way());
}

TEST(Room, the_address_with_the_most_sessions_gives_way) {
  MemorySessions sessions;
  for (const uint64_t id : {1, 2, 3}) sessions.join(id, "10.0.0.1", viewer);
  sessions.join(4, "10.0.0.2", viewer);
  Room room;
  room.fit(4);
  const auto newcomer = sessions.connect(9, "10.0.0.9");
  EXPECT_TRUE(room.find_place(sessions.table, *newcomer, viewer, 0, sessions.now_s));
  ASSERT_EQ(sessions.reasons.size(), 1U);
  EXPECT_LE(sessions.reasons.begin()->first, 3U);
  EXPECT_EQ(sessions.reasons.begin()->second, Refusal::idle_made_room);
}

/// A full server whose places these addresses hold, and how many of `knocks` newcomers, each of an address of
/// its own, come in.
size_t let_in(size_t places, size_t knocks, const std::function<std::string(size_t)>& holder_of) {
  MemorySessions sessions;
  Room room;
  room.fit(static_cast<uint32_t>(places));
  uint64_t id = 1;
  for (size_t i = 0; i < places; ++i) sessions.join(id++, holder_of(i), viewer);
  size_t came_in = 0;
  for (size_t i = 0; i < knocks; ++i) {
    const auto newcomer = sessions.connect(id++, fmt::format("198.51.100.{}", i));
    if (!room.find_place(sessions.table, *newcomer, viewer, 0, sessions.now_s)) continue;
    ++came_in;
    for (const auto& [gone, reason] : sessions.reasons)
      if (const auto* const entry = sessions.table.find(gone)) entry->session->close("gone");
    newcomer->close("it joins");
    sessions.join(id++, fmt::format("198.51.100.{}", i), viewer);
  }
  return came_in;
}

TEST(Room, neither_a_few_addresses_nor_the_networks_of_one_site_hold_a_server) {
  EXPECT_EQ(let_in(64, 15, [](size_t i) { return fmt::format("203.0.113.{}", i % 4); }), 15U);
  EXPECT_EQ(let_in(64, 15, [](size_t i) { return fmt::format("2001:db8:1:1{:02x}::1", i); }), 15U);
  EXPECT_EQ(let_in(64, 15, [](size_t i) { return fmt::format("2001:db8:1:{:x}01::1", i + 1); }), 15U)
      << "of a /48";
}

TEST(Room, households_and_single_persons_keep_their_places_while_they_play) {
  EXPECT_EQ(let_in(64, 15, [](size_t i) { return fmt::format("203.0.113.{}", i / 2); }), 0U);
  EXPECT_EQ(let_in(64, 15, [](size_t i) { return fmt::format("2001:db8:{:x}:1::1", i); }), 0U);
}

TEST(Outsiders, those_of_whom_there_are_most_leave_first_then_the_oldest) {
  std::vector<Outsider> outsiders;
  uint64_t id = 1;
  const auto add = [&](const std::string& ip, bool is_done, bool is_silent) {
    outsiders.push_back({id++, Origin(door_address(ip)), is_done, is_silent});
  };
  add("198.51.100.1", false, true);
  add("198.51.100.2", false, false);
  EXPECT_EQ(who_leaves(outsiders).id, 1U) << "it is silent";
  add("198.51.100.5", false, false);
  EXPECT_EQ(who_leaves(outsiders).id, 2U) << "most have begun to speak, and it is the oldest of them";
  add("198.51.100.3", true, false);
  EXPECT_EQ(who_leaves(outsiders).id, 4U) << "nobody waits for it";
  add("198.51.100.4", true, true);
  for (int i = 0; i < 64; ++i) add(fmt::format("2001:db8:1:1{:02x}::1", i), false, false);
  EXPECT_EQ(who_leaves(outsiders).id, 6U) << "one site holds most";
}

TEST(Room, of_those_who_may_go_one_of_the_address_with_the_most_sessions_goes) {
  MemorySessions sessions;
  sessions.join(1, "10.0.0.2", viewer);
  sessions.now_s += limits::inert_seconds_max + 1.0;
  for (const uint64_t id : {2, 3, 4}) sessions.join(id, "10.0.0.1", viewer);
  const auto newcomer = sessions.connect(9, "10.0.0.9");
  const auto leaver = who_gives_way(sessions.table, newcomer->origin(), viewer, sessions.now_s);
  ASSERT_TRUE(leaver);
  EXPECT_EQ(leaver->session->address(), "10.0.0.1") << "though the other one is idle for longer";
}

TEST(Room, places_that_are_kept_are_no_newcomers_but_at_most_a_quarter_is_kept) {
  MemorySessions sessions;
  Room room;
  room.fit(4);
  const auto newcomer = sessions.connect(9, "10.0.0.1");
  const auto finds_place = [&](size_t reserved) {
    return room.find_place(sessions.table, *newcomer, viewer, reserved, sessions.now_s).has_value();
  };
  for (const uint64_t id : {1, 2}) sessions.join(id, fmt::format("10.0.1.{}", id), viewer);
  EXPECT_TRUE(finds_place(4));
  sessions.join(3, "10.0.1.3", viewer);
  EXPECT_FALSE(finds_place(4));
  EXPECT_FALSE(room.has_place(sessions.table, 4, sessions.now_s)) << "and says so to who asks for its health";
  EXPECT_TRUE(finds_place(0));
  EXPECT_TRUE(room.has_place(sessions.table, 0, sessions.now_s));
  room.bound(3);
  EXPECT_FALSE(finds_place(0));
}

TEST(Room, counts_those_alone_that_need_a_place) {
  MemorySessions sessions;
  Room room;
  room.fit(1);
  sessions.join(1, "10.0.0.1", {.role = Role::admin});
  sessions.table.at(sessions.join(2, "10.0.0.2", viewer)->id()).administers = true;
  const auto newcomer = sessions.connect(9, "10.0.0.3");
  EXPECT_TRUE(room.find_place(sessions.table, *newcomer, viewer, 0, sessions.now_s));
  EXPECT_TRUE(room.has_place(sessions.table, 0, sessions.now_s));
  sessions.join(3, "10.0.0.3", viewer);
  EXPECT_FALSE(room.find_place(sessions.table, *newcomer, viewer, 0, sessions.now_s));
  EXPECT_FALSE(room.has_place(sessions.table, 0, sessions.now_s));
  sessions.now_s += limits::idle_seconds_max + 1.0;
  EXPECT_TRUE(room.has_place(sessions.table, 0, sessions.now_s)) << "who is idle would go";
  EXPECT_TRUE(sessions.reasons.empty());
}

TEST(Room, programs_that_administer_by_any_token_keep_no_administrator_out) {
  MemorySessions sessions;
  for (uint64_t id = 1; id <= limits::administrators_max; ++id) {
    sessions.join(id, "10.0.0.1", holder(id));
    sessions.table.at(id).administers = true;
  }
  const SessionEntry& newcomer = sessions.table.at(sessions.connect(99, "10.0.0.2")->id());
  EXPECT_FALSE(Room::find_room_beside(sessions.table, newcomer, holder(99)));
  EXPECT_TRUE(sessions.reasons.empty());
  EXPECT_TRUE(Room::find_room_beside(sessions.table, newcomer, {.role = Role::admin}));
  ASSERT_EQ(sessions.reasons.size(), 1U);
  EXPECT_EQ(sessions.reasons.begin()->first, 1U) << "it came first";
}

class ReturnsTest : public ::testing::Test {
 protected:
  ReturnsTest() {
    sessions.on_closed = [this](const SessionEntry& entry) { returns.closed(entry, sessions.now_s); };
  }
  auto resume(const std::string& ticket, const Grant& grant) {
    return returns.resume(ticket, grant, sessions.table, sessions.now_s);
  }

  std::vector<uint64_t> over;
  Door door{Door::Rules{}};
  MemorySessions sessions;
  Returns returns{[this](uint64_t session) { over.push_back(session); }, door};
};

TEST_F(ReturnsTest, a_session_goes_on_by_its_ticket_and_its_old_connection_ends) {
  sessions.join(1, "10.0.0.1", holder(7));
  const std::string ticket = returns.tickets().issue(1);
  const auto before = resume(ticket, holder(7));
  ASSERT_TRUE(before);
  EXPECT_EQ(before->session, 1U);
  EXPECT_TRUE(before->reserves_place);
  EXPECT_TRUE(sessions.links[1]->closed());
  EXPECT_EQ(sessions.table.find(1), nullptr);
  EXPECT_EQ(returns.tickets_void(), 0U);
}

TEST_F(ReturnsTest, a_ticket_opens_no_session_of_another_token) {
  sessions.join(1, "10.0.0.1", holder(7));
  const std::string ticket = returns.tickets().issue(1);
  EXPECT_FALSE(resume(ticket, holder(8)));
  EXPECT_EQ(returns.tickets_void(), 1U);
  EXPECT_NE(sessions.table.find(1), nullptr) << "its connection stays";
  EXPECT_FALSE(resume("", holder(7)));
  EXPECT_EQ(returns.tickets_void(), 1U) << "no ticket was presented";
}

TEST_F(ReturnsTest, a_session_that_leaves_is_over_and_one_that_is_lost_is_not) {
  const auto leaves = sessions.join(1, "10.0.0.1", viewer), lost = sessions.join(2, "10.0.0.1", viewer);
  for (const uint64_t id : {1, 2}) returns.tickets().issue(id);
  leaves->leave();
  sessions.links[2]->end(false);
  sessions.pump(2);
  EXPECT_EQ(over, std::vector<uint64_t>{1});
  ASSERT_NE(returns.tickets().departed(2), nullptr);
  EXPECT_TRUE(returns.tickets().departed(2)->reserves_place);
}

TEST_F(ReturnsTest, sessions_of_one_token_or_one_address_are_one_party) {
  const auto a = sessions.join(1, "10.0.0.1"), b = sessions.join(2, "10.0.0.1");
  const auto here = sessions.join(3, "127.0.0.1"), too = sessions.join(4, "127.0.0.1");
  const auto party = [&](const auto& session, const Grant& grant) {
    return returns.join_party(*session, grant, 0, sessions.now_s);
  };
  EXPECT_EQ(party(a, viewer), party(b, viewer));
  EXPECT_EQ(party(a, holder(7)), party(here, holder(7)));
  EXPECT_NE(party(here, viewer), party(too, viewer)) << "programs on this machine share with nobody";
  EXPECT_EQ(party(b, {.role = Role::admin}), 0U);
}

TEST(FlushQueue, a_session_waits_once_and_is_sent_all_that_is_queued) {
  MemorySessions sessions;
  asio::io_context context;
  Workers workers(1);
  FlushQueue queue(context, workers, 60);
  const auto session = sessions.join(1, "10.0.0.1");
  sessions.pump(1);
  sessions.links[1]->drain_arrived();
  const SharedBytes bytes = share(ResetMessage{});
  for (const Tick tick : {1, 2}) {
    queue.add(session, tick, steady_now_s());
    session->queue(bytes);
  }
  sessions.pump(1);
  EXPECT_TRUE(sessions.links[1]->drain_arrived().empty());
  queue.send_turn(2, true);
  sessions.pump(1);
  EXPECT_TRUE(sessions.links[1]->drain_arrived().empty()) << "the next tick waits already";
  queue.send_turn(2, false);
  sessions.pump(1);
  EXPECT_EQ(sessions.links[1]->drain_arrived().size(), 2 * bytes->size());
  EXPECT_FALSE(session->wait_for_flush()) << "it does not wait any more";
  EXPECT_EQ(queue.frame_age().count(), 1U) << "by its first message, which has waited longest";
}

TEST(FlushQueue, a_session_that_waited_for_so_many_ticks_is_sent_its_messages_though_more_wait) {
  MemorySessions sessions;
  asio::io_context context;
  Workers workers(1);
  FlushQueue queue(context, workers, 60);
  const auto early = sessions.join(1, "10.0.0.1"), late = sessions.join(2, "10.0.0.1");
  for (const uint64_t id : {1, 2}) sessions.links[id]->drain_arrived();
  const SharedBytes bytes = share(ResetMessage{});
  queue.add(early, 1, steady_now_s());
  early->queue(bytes);
  queue.add(late, limits::ticks_per_flush_max, steady_now_s());
  late->queue(bytes);
  queue.send_turn(limits::ticks_per_flush_max, true);
  for (const uint64_t id : {1, 2}) sessions.pump(id);
  EXPECT_EQ(sessions.links[1]->drain_arrived().size(), bytes->size());
  EXPECT_TRUE(sessions.links[2]->drain_arrived().empty());
}

}  // namespace
}  // namespace scree
