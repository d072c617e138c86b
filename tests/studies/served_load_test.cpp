// Which loads count as held, and which as carried out.
#include "studies/scale/served_load.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

ServedLoad served_well() {
  ServedLoad served;
  served.turns_per_s = served.carves_per_s = 20.0;
  served.reply_p99_ms = 80.0;
  served.ticks_per_s = 60.0;
  return served;
}

TEST(ServedLoad, holds_when_all_is_in_time) {
  EXPECT_TRUE(served_well().holds());
  EXPECT_TRUE(served_well().carried_out());
}

TEST(ServedLoad, of_which_bots_miss_turns_does_not_hold) {
  ServedLoad served = served_well();
  served.carves_per_s = 18.5;
  EXPECT_FALSE(served.holds()) << "though those that were asked for were answered in time";
  EXPECT_TRUE(served.carried_out());
  served.carves_per_s = 17.0;
  EXPECT_FALSE(served.carried_out());
}

TEST(ServedLoad, with_late_ticks_refusals_or_lost_clients_was_not_carried_out) {
  ServedLoad late = served_well(), refused = served_well(), lost = served_well();
  late.ticks_per_s = 58.0;
  refused.refused = 0.01;
  lost.lost = 1;
  for (const ServedLoad& served : {late, refused, lost}) {
    EXPECT_FALSE(served.holds());
    EXPECT_FALSE(served.carried_out());
  }
}

TEST(ServedLoad, with_late_answers_does_not_hold_but_was_carried_out) {
  ServedLoad served = served_well();
  served.reply_p99_ms = 1001.0;
  EXPECT_FALSE(served.holds());
  EXPECT_TRUE(served.carried_out());
}

TEST(ServedLoad, requests_without_an_answer_count_as_late) {
  const std::vector<double> answered_ms(98, 10.0);
  EXPECT_EQ(reply_p99_of(answered_ms, 0), 10.0);
  EXPECT_GT(reply_p99_of(answered_ms, 2), reply_max_ms);
  EXPECT_GT(reply_p99_of({}, 1), reply_max_ms);
  EXPECT_EQ(reply_p99_of({}, 0), 0.0);
}

}  // namespace
}  // namespace scree
