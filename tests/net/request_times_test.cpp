// The stages of a request's way: what a reply, a status and a report say of them.
#include "server/net/request_times.h"

#include "proto/limits.h"
#include "server/net/limits.h"
#include "shared/base/timing.h"
#include "tests/support/net_server_fixture.h"

namespace scree {
namespace {

TEST(RequestTimes, a_request_is_measured_from_its_arrival_to_its_reply) {
  RequestTimes times;
  times.received(7, 1, 10.000);
  times.received(7, 2, 10.004);
  const TickSpan tick{10.010, 10.013};
  EXPECT_EQ(times.answered(7, 2, tick, 10.0145), (ServerLatency{6000, 3000, 1500}));
  // The other one had to wait for the next tick.
  const TickSpan next{10.0275, 10.028};
  const ServerLatency latency = times.answered(7, 1, next, 10.029);
  EXPECT_NEAR(latency.waiting_us, 27500, 1);
  EXPECT_NEAR(latency.total_ms(), 29.0, 0.01);
  EXPECT_EQ(times.answered(7, 1, next, 10.029), ServerLatency{}) << "answered before";
  EXPECT_EQ(times.counts()[0].count(), 2U);
}

TEST(RequestTimes, the_same_number_again_is_another_request) {
  RequestTimes times;
  times.received(7, 1, 1.0);
  times.received(8, 1, 2.0);
  times.received(7, 1, 3.0);
  EXPECT_EQ(times.answered(7, 1, instant(4.0), 4.0).waiting_us, 3000000U);
  EXPECT_EQ(times.answered(7, 1, instant(4.0), 4.0).waiting_us, 1000000U);
  times.forget(8);
  EXPECT_EQ(times.answered(8, 1, instant(4.0), 4.0), ServerLatency{});
}

TEST(RequestTimes, stages_are_bounded_and_never_negative) {
  RequestTimes times;
  times.received(1, 1, 100.0);
  EXPECT_EQ(times.answered(1, 1, {1e9, 1.0}, 1e300),
            (ServerLatency{limits::latency_max_us, 0, limits::latency_max_us}));
  for (uint32_t i = 0; i < limits::requests_timed_max + 10; ++i) times.received(1, i, 1.0);
  EXPECT_GT(times.answered(1, limits::requests_timed_max - 1, instant(2.0), 2.0).waiting_us, 0U);
  EXPECT_EQ(times.answered(1, limits::requests_timed_max + 5, instant(2.0), 2.0), ServerLatency{});
  times.forget(1);
  times.received(1, 5, 1.0);
  EXPECT_GT(times.answered(1, 5, instant(2.0), 2.0).waiting_us, 0U) << "there is room again";
}

TEST(RequestTimes, a_status_has_the_median_and_the_worst_since_the_one_before) {
  RequestTimes times;
  EXPECT_EQ(times.drain_status(), LatencyStatus{});
  for (uint32_t i = 1; i <= 9; ++i) {
    times.received(1, i, 5.0);
    times.answered(1, i, {5.0 + 0.001 * i, 5.0 + 0.001 * i}, 5.02);
  }
  const LatencyStatus status = times.drain_status();
  EXPECT_NEAR(status.median.waiting_us, 5000, 1);
  EXPECT_NEAR(status.worst.waiting_us, 9000, 1);
  EXPECT_EQ(times.drain_status(), LatencyStatus{}) << "those were told";
}

TEST_F(NetServerTest, a_reply_says_how_long_each_stage_took) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  const auto welcome = client.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome.has_value());
  PaintMessage paint{{sphere({0.0F, 0.0F, 0.0F}, 1.0F), material::ice}, 5};
  ASSERT_TRUE(client.send(paint));
  std::vector<Command> taken;
  const auto deadline = std::chrono::steady_clock::now() + seconds(10);
  while (taken.empty() && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(1));
    taken = commands.drain();
  }
  ASSERT_EQ(taken.size(), 1U);
  auto delta = std::make_shared<TickDelta>(*source.step());
  delta->replies.push_back({taken[0].session, taken[0].request, "", 0});
  const double now_s = steady_now_s();
  server->publish(delta, {now_s + 20.0, now_s + 20.25});  // a tick of a quarter of a second, as it says
  const auto reply = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(reply.has_value());
  EXPECT_GE(reply->latency.waiting_us, 20000000U);
  EXPECT_NEAR(reply->latency.tick_us, 250000, 2);
  EXPECT_EQ(reply->latency.sending_us, 0U) << "the tick ends later than it was sent";
  server->flush();
  EXPECT_EQ(server->latency()[1].count(), 1U);
  EXPECT_NEAR(server->latency()[1].worst_ms(), 250.0, 0.01);
}

}  // namespace
}  // namespace scree
