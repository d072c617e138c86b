// The budget of bytes out: who stays within it has room always, who does not gets its rate, and nobody gets
// less for what others draw.
#include "server/doors/bytes_out.h"

#include <deque>
#include <gtest/gtest.h>
#include <numeric>

#include "server/net/ground_pace.h"

namespace scree {
namespace {

constexpr double tick_s = 1.0 / 60.0;
constexpr const char* attacker = "203.0.113.1";
constexpr const char* household = "203.0.113.2";
constexpr const char* loopback = "loopback";

class BytesOutTest : public ::testing::Test {
 protected:
  BytesOut::Receiver receiver(const std::string& address) {
    return receivers.emplace_back(BytesOut::Receiver{address, &accounts.emplace_back()});
  }
  void open(const std::string& address, size_t count) {
    for (size_t i = 0; i < count; ++i) budget.open(receiver(address), now_s);
  }
  /// A tick in which each receiver of the address is sent messages of so many bytes while it has room.
  void draw(const std::string& address, uint64_t message_bytes, uint64_t tick_bytes_max = 64 * 1024) {
    for (const auto& [of, account] : receivers)
      for (uint64_t sent = 0; of == address && account->room > 0 && sent < tick_bytes_max;
           sent += message_bytes)
        budget.charge(*account, message_bytes);
  }
  void share() {
    now_s += tick_s;
    budget.share(receivers, now_s);
  }
  uint64_t drawn(const std::string& address) const {
    uint64_t sum = 0;
    for (const auto& [of, account] : receivers) sum += of == address ? account->charged : 0;
    return sum;
  }

  Door door{{64, 10.0, 64.0}};
  double now_s = 1000.0;
  BytesOut budget{{1.0e6, 10.0e6}, door};
  std::deque<ByteAccount> accounts;
  std::vector<BytesOut::Receiver> receivers;
};

TEST_F(BytesOutTest, who_stays_within_the_budget_has_room_always) {
  open(household, 4);
  for (int tick = 0; tick < 600; ++tick) {
    share();
    for (const auto& [of, account] : receivers) {
      ASSERT_GT(account->room, 0) << tick;
      budget.charge(*account, 4000);  // 0.96 MB/s together
    }
  }
  EXPECT_EQ(budget.held_back(), 0U);
}

TEST_F(BytesOutTest, an_address_draws_its_rate_and_what_it_saved_however_many_its_sessions) {
  open(attacker, 60);
  for (int tick = 0; tick < 1200; ++tick) {
    share();
    draw(attacker, 32 * 1024);
  }
  const double most = 1.0e6 * (20.0 + limits::bytes_out_saved_s) + 60 * 32 * 1024;
  EXPECT_LE(static_cast<double>(drawn(attacker)), most);
  EXPECT_GE(static_cast<double>(drawn(attacker)), 0.95 * 1.0e6 * 20.0) << "the budget is used";
  EXPECT_GT(budget.held_back(), 1000U);
  uint64_t least = UINT64_MAX, greatest = 0;
  for (const auto& [of, account] : receivers) {
    least = std::min(least, account->charged);
    greatest = std::max(greatest, account->charged);
  }
  EXPECT_LE(greatest - least, 2 * 512 * 1024U) << "its sessions have equal parts";
}

TEST_F(BytesOutTest, another_address_does_not_notice) {
  open(attacker, 60);
  open(household, 1);
  for (int tick = 0; tick < 600; ++tick) {
    share();
    draw(attacker, 32 * 1024);
    ASSERT_GT(accounts.back().room, 0) << tick;
    budget.charge(accounts.back(), 15000);  // 0.9 MB/s
  }
}

TEST_F(BytesOutTest, where_all_together_have_too_little_addresses_share_it_alike) {
  for (int i = 0; i < 40; ++i) open("198.51.100." + std::to_string(i), 10);  // 40 MB/s wanted, 10 there
  open(household, 1);
  const auto one_second = [&] {
    for (int tick = 0; tick < 60; ++tick) {
      share();
      for (int i = 0; i < 40; ++i) draw("198.51.100." + std::to_string(i), 8 * 1024);
      draw(household, 8 * 1024);
    }
  };
  for (int i = 0; i < 10; ++i) one_second();  // what they saved is used up
  const uint64_t before = budget.bytes(), of_household = drawn(household);
  for (int i = 0; i < 10; ++i) one_second();
  EXPECT_NEAR(static_cast<double>(budget.bytes() - before), 100.0e6, 5.0e6);
  EXPECT_NEAR(static_cast<double>(drawn(household) - of_household), 100.0e6 / 41.0, 0.25e6);
}

TEST_F(BytesOutTest, who_ends_and_begins_anew_takes_its_debts_along) {
  uint64_t drawn_bytes = 0;
  for (int tick = 0; tick < 1200; ++tick) {
    receivers.clear();
    open(attacker, 20);
    share();
    draw(attacker, 256 * 1024, 1024 * 1024);
    drawn_bytes += drawn(attacker);
    for (const auto& one : receivers) budget.close(one);
  }
  EXPECT_LE(static_cast<double>(drawn_bytes), 1.0e6 * (20.0 + limits::bytes_out_saved_s) + 20 * 256 * 1024);
}

TEST_F(BytesOutTest, what_must_not_wait_is_charged_and_its_debt_is_bounded) {
  open(household, 1);
  for (int i = 0; i < 10; ++i) {
    budget.charge(accounts.front(), 4'000'000);
    share();
  }
  EXPECT_LE(accounts.front().room, 0);
  int ticks = 0;
  for (; accounts.front().room <= 0 && ticks < 1000; ++ticks) share();
  EXPECT_LT(ticks, 60 * 8);
}

TEST_F(BytesOutTest, this_machine_has_no_budget_and_a_proxy_that_speaks_for_many_that_of_all) {
  open(loopback, 1);
  open("", 1);
  for (int tick = 0; tick < 300; ++tick) {
    share();
    draw(loopback, 1'000'000, 100'000'000);
    draw("", 256 * 1024, 4'000'000);
  }
  EXPECT_EQ(drawn(loopback), uint64_t{300} * 100'000'000);
  EXPECT_GE(static_cast<double>(drawn("")), 0.9 * 10.0e6 * 5.0);
  EXPECT_LE(static_cast<double>(drawn("")), 10.0e6 * (5.0 + limits::bytes_out_saved_s_all) + 1.0e6);
}

TEST_F(BytesOutTest, no_limit_is_a_limit_of_its_own) {
  BytesOut unbounded({0.0, 0.0}, door);
  ByteAccount account;
  const BytesOut::Receiver one{attacker, &account};
  unbounded.open(one, now_s);
  for (int tick = 0; tick < 100; ++tick) {
    unbounded.share({one}, now_s += tick_s);
    ASSERT_EQ(account.room, limits::bytes_out_at_once);
    unbounded.charge(account, 500'000);
  }
}

TEST_F(BytesOutTest, addresses_that_have_saved_all_they_can_are_forgotten) {
  for (int i = 0; i < 200; ++i) open("198.51.100." + std::to_string(i), 1);
  EXPECT_EQ(budget.addresses(), 200U);
  for (const auto& one : receivers) budget.close(one);
  receivers.clear();
  share();
  EXPECT_EQ(budget.addresses(), 0U);
}

TEST(EvenParts, nobody_gets_more_than_it_wants_and_the_rest_is_for_the_others) {
  using Parts = std::vector<int64_t>;
  EXPECT_EQ(even_parts({10, 100, 100}, 110), (Parts{10, 50, 50}));
  EXPECT_EQ(even_parts({10, 20, 30}, 1000), (Parts{10, 20, 30}));
  EXPECT_EQ(even_parts({5, 5, 5}, 0), (Parts{0, 0, 0}));
  EXPECT_EQ(even_parts({5, 5}, -7), (Parts{0, 0}));
  EXPECT_EQ(even_parts({}, 7), Parts{});
  const Parts odd = even_parts({100, 100, 100}, 100);
  EXPECT_EQ(std::accumulate(odd.begin(), odd.end(), int64_t{0}), 100);
}

TEST(GroundPace, rises_while_there_is_time_and_falls_at_once) {
  GroundPace pace;
  EXPECT_EQ(pace.work_per_tick(), limits::ground_work_min);
  for (int i = 0; i < 200; ++i) pace.ticked(0.001, tick_s, false);
  EXPECT_EQ(pace.work_per_tick(), limits::ground_work_max);
  pace.ticked(0.4 * tick_s, tick_s, false);
  EXPECT_EQ(pace.work_per_tick(), limits::ground_work_max) << "as busy as it should be";
  pace.ticked(0.6 * tick_s, tick_s, false);
  EXPECT_EQ(pace.work_per_tick(), limits::ground_work_max / 2);
  for (int i = 0; i < 10; ++i) pace.ticked(0.001, tick_s, true);
  EXPECT_EQ(pace.work_per_tick(), limits::ground_work_min) << "the next tick waits";
}

}  // namespace
}  // namespace scree
