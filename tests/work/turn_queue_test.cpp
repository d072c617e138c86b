#include "server/work/turn_queue.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

struct Job {
  int number = 0;
  float cost_us = 0.0F;
};

std::vector<int> served(TurnQueue<Job>& queue) {
  std::vector<int> order;
  while (!queue.empty()) order.push_back(queue.pop(queue.next().cost_us).number);
  return order;
}

TEST(turn_queue, each_ones_work_keeps_its_order_and_all_take_turns) {
  TurnQueue<Job> queue;
  for (int number = 10; number < 14; ++number) queue.push(1, {number, 100.0F});
  for (int number = 20; number < 22; ++number) queue.push(2, {number, 100.0F});
  EXPECT_EQ(queue.size(), 6U);
  EXPECT_TRUE(queue.waits(1) && queue.others_wait(1) && queue.others_wait(3));
  EXPECT_EQ(served(queue), (std::vector{10, 20, 11, 21, 12, 13}));
  EXPECT_EQ(queue.size(), 0U);
  EXPECT_FALSE(queue.waits(1));
}

TEST(turn_queue, what_has_no_price_before_is_charged_afterwards) {
  TurnQueue<Job> queue;
  for (int number = 10; number < 12; ++number) queue.push(1, {number, 0.0F});
  for (int number = 20; number < 24; ++number) queue.push(2, {number, 0.0F});
  std::vector<int> order;
  while (!queue.empty()) {
    const bool dear = queue.whose() == 1;
    order.push_back(queue.pop(dear ? 300.0F : 100.0F).number);
  }
  EXPECT_EQ(order, (std::vector{10, 20, 21, 22, 11, 23}));
}

TEST(turn_queue, work_that_goes_on_waits_for_its_next_turn) {
  TurnQueue<Job> queue;
  queue.push(1, {1, 0.0F});
  queue.push(2, {2, 0.0F});
  EXPECT_EQ(queue.whose(), 1U);
  queue.go_on(50.0F, 0.0F);
  EXPECT_EQ(queue.whose(), 2U);
  queue.go_on(80.0F, 0.0F);
  EXPECT_EQ(queue.whose(), 1U);
  EXPECT_EQ(queue.size(), 2U);
}

TEST(turn_queue, who_had_much_comes_later_though_nothing_waited_for_him_in_between) {
  TurnQueue<Job> queue;
  queue.push(1, {1, 900.0F});
  queue.push(2, {2, 1000.0F});
  queue.begin_tick();
  EXPECT_EQ(queue.whose(), 1U);
  queue.pop(900.0F);
  queue.clear();
  queue.push(1, {3, 100.0F});
  queue.push(2, {4, 500.0F});
  queue.begin_tick();
  EXPECT_EQ(queue.whose(), 2U);
}

TEST(turn_queue, who_is_passed_over_waits_for_the_next_tick) {
  TurnQueue<Job> queue;
  queue.push(1, {1, 10.0F});
  queue.push(2, {2, 20.0F});
  queue.pass_over();
  EXPECT_EQ(served(queue), (std::vector{2}));
  EXPECT_EQ(queue.size(), 1U);
  queue.begin_tick();
  EXPECT_EQ(served(queue), (std::vector{1}));
}

TEST(turn_queue, what_is_dropped_or_erased_leaves_the_rest_in_order) {
  TurnQueue<Job> queue;
  for (int number = 10; number < 13; ++number) queue.push(1, {number, 100.0F});
  queue.push(2, {20, 100.0F});
  queue.push(3, {30, 100.0F});
  queue.pass_over();
  queue.erase_if([](const Job& job) { return job.number == 10 || job.number == 30; });
  EXPECT_EQ(queue.size(), 3U);
  EXPECT_FLOAT_EQ(queue.lines().at(1).waiting_us, 200.0F);
  EXPECT_EQ(queue.drop(2).size(), 1U);
  EXPECT_TRUE(queue.drop(2).empty());
  EXPECT_EQ(served(queue), (std::vector{11, 12}));
}

}  // namespace
}  // namespace scree
