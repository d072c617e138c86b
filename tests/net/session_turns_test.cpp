// Whose turn it is among sessions: parties share alike, however many sessions they have.
#include "server/publish/session_turns.h"

#include <gtest/gtest.h>
#include <map>

namespace scree {
namespace {

using Then = FairTurns::Then;

TEST(SessionTurns, a_party_of_many_sessions_has_as_many_turns_as_a_party_of_one) {
  SessionTurns turns;
  for (uint64_t session = 1; session <= 60; ++session) turns.wait(session, 1);
  turns.wait(100, 100);
  std::map<uint64_t, int> had;
  turns.begin();
  for (int i = 0; i < 120; ++i) {
    ++had[turns.next()];
    turns.charge(1000, Then::waits);
  }
  turns.end();
  EXPECT_EQ(had[100], 60);
  for (uint64_t session = 1; session <= 60; ++session) EXPECT_EQ(had[session], 1) << session;
}

TEST(SessionTurns, dear_work_of_one_party_gives_the_other_more_turns) {
  SessionTurns turns;
  turns.wait(1, 1);
  turns.wait(2, 2);
  std::map<uint64_t, int> had;
  turns.begin();
  for (int i = 0; i < 90; ++i) {
    const uint64_t session = turns.next();
    ++had[session];
    turns.charge(session == 1 ? 8000 : 1000, Then::waits);
  }
  turns.end();
  EXPECT_NEAR(had[1], 10, 1);
}

TEST(SessionTurns, who_is_passed_over_waits_in_the_next_round_and_who_leaves_does_not) {
  SessionTurns turns;
  turns.wait(1, 7);
  turns.wait(2, 7);
  turns.wait(3, 8);
  turns.wait(3, 8);
  turns.begin();
  int passed = 0;
  for (; !turns.empty(); ++passed) turns.pass_over();
  EXPECT_EQ(passed, 3);
  turns.end();
  turns.leave(2);
  turns.leave(2);
  turns.begin();
  std::map<uint64_t, int> had;
  for (; !turns.empty(); turns.charge(1, Then::leaves)) ++had[turns.next()];
  turns.end();
  EXPECT_EQ(had, (std::map<uint64_t, int>{{1, 1}, {3, 1}}));
  turns.begin();
  EXPECT_TRUE(turns.empty());
  turns.end();
}

TEST(SessionTurns, what_was_charged_stands_over_rounds_for_who_still_waits) {
  SessionTurns turns;
  turns.wait(1, 1);
  turns.wait(2, 2);
  int of_first = 0;
  for (int round = 0; round < 20; ++round) {  // one turn a round
    turns.begin();
    of_first += turns.next() == 1 ? 1 : 0;
    turns.charge(500, Then::waits);
    turns.end();
  }
  EXPECT_EQ(of_first, 10);
}

}  // namespace
}  // namespace scree
