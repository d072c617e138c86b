// Who is one party with whom.
#include "server/doors/parties.h"

#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "server/doors/limits.h"
#include "server/work/request_queue.h"

namespace scree {
namespace {

TEST(Parties, have_the_number_of_their_first_session_and_keep_it_for_a_while) {
  Parties parties;
  EXPECT_EQ(parties.join("here", 1, 0.0), 1U);
  EXPECT_EQ(parties.join("there", 2, 0.0), 2U);
  EXPECT_EQ(parties.join("here", 3, 0.0), 1U);
  parties.leave(1, 1.0);
  parties.leave(1, 1.0);
  EXPECT_EQ(parties.join("here", 4, 1.0 + limits::party_memory_s), 1U) << "by coming again nobody is another";
  parties.leave(1, 20.0);
  EXPECT_EQ(parties.join("here", 5, 20.1 + limits::party_memory_s), 5U);
  EXPECT_EQ(parties.join("there", 6, 1000.0), 2U) << "its session lasts";
}

TEST(Parties, of_this_machine_are_as_many_as_are_there_at_once) {
  Parties parties;
  for (const uint64_t session : {1U, 2U, 3U}) EXPECT_EQ(parties.join_apart(session, 0, 0.0), session);
  EXPECT_EQ(parties.join("elsewhere", 4, 0.0), 4U);
  parties.leave(4, 0.5);
  parties.leave(2, 1.0);
  parties.leave(3, 2.0);
  EXPECT_EQ(parties.join_apart(5, 0, 3.0), 3U) << "the one that was left last";
  EXPECT_EQ(parties.join_apart(6, 0, 3.0), 2U);
  EXPECT_EQ(parties.join_apart(7, 0, 3.0), 7U) << "nobody is made to share";
  parties.leave(7, 4.0);
  EXPECT_EQ(parties.join_apart(8, 0, 4.1 + limits::party_memory_s), 8U) << "debts end";
}

TEST(Parties, a_session_of_this_machine_that_goes_on_finds_its_own_party) {
  Parties parties;
  EXPECT_EQ(parties.join_apart(1, 0, 0.0), 1U);
  EXPECT_EQ(parties.join_apart(2, 0, 0.0), 2U);
  parties.leave(1, 1.0);
  parties.leave(2, 2.0);
  EXPECT_EQ(parties.join_apart(1, 1, 3.0), 1U) << "where its requests wait";
  EXPECT_EQ(parties.join_apart(3, 0, 3.0), 2U);
  EXPECT_EQ(parties.join_apart(2, 2, 3.0), 2U) << "with who has taken it over";
  parties.leave(2, 4.0);
  EXPECT_EQ(parties.join_apart(4, 0, 4.0), 4U) << "somebody is still there";
}

/// How many of 40 turns one gets that asks all the time, beside programs that come, ask and go.
size_t turns_beside(size_t comers_at_once) {
  Parties parties;
  RequestQueue queue(1.0e6F);
  const uint64_t steady = parties.join_apart(1, 0, 0.0);
  size_t own = 0;
  std::vector<uint64_t> there;
  for (uint64_t turn = 0; turn < 40; ++turn) {
    const double now_s = 0.1 * static_cast<double>(turn);
    EXPECT_TRUE(queue.push({{1, 0, PaintRequest{}, steady}, 100.0F}));
    for (const uint64_t party : std::exchange(there, {})) parties.leave(party, now_s);
    for (size_t i = 0; i < comers_at_once; ++i) {
      const uint64_t session = 100 + turn * comers_at_once + i;
      there.push_back(parties.join_apart(session, 0, now_s));
      EXPECT_TRUE(queue.push({{session, 0, PaintRequest{}, there.back()}, 100.0F}));
    }
    own += queue.next()->command.session == 1 ? 1 : 0;
    queue.pop(100.0F);
    queue.begin_tick();
  }
  return own;
}

TEST(Parties, on_this_machine_nobody_gains_by_coming_and_going) {
  EXPECT_NEAR(static_cast<double>(turns_beside(1)), 20.0, 1.0);
  EXPECT_NEAR(static_cast<double>(turns_beside(3)), 10.0, 1.0) << "as beside three that stay";
}

}  // namespace
}  // namespace scree
