// One client's feed without a publisher: what a replay tells once, and how a link bounds what is sent.
#include "server/publish/client_feed.h"

#include <gtest/gtest.h>

#include "proto/codec.h"

namespace scree {
namespace {

class ReplayNewsTest : public ::testing::Test {
 protected:
  ReplayNewsTest() {
    delta.playback = PlaybackMessage{.moment = 5, .last = 100};
    delta.marks = std::make_shared<const MarksMessage>();
    delta.cursors = std::make_shared<const RecordedCursorsMessage>();
  }
  /// The messages that a tick sends.
  std::vector<ServerMessage> serve(bool in_full = false, bool reads_along = true) {
    ServedPart part;
    feed.serve(delta, in_full, reads_along, outlet, part);
    std::vector<ServerMessage> messages;
    for (const Outgoing& outgoing : part.out)
      messages.push_back(*decode_server(std::span(*outgoing.bytes).subspan(length_prefix_bytes)));
    return messages;
  }

  TickDelta delta;
  Outlet outlet{7};
  ReplayNews feed;
};

TEST_F(ReplayNewsTest, tells_where_the_replay_stands_and_then_only_what_is_new) {
  feed.set_control_refusal("viewers may not");
  const auto first = serve();
  ASSERT_EQ(first.size(), 2U) << "an empty list of cursors is no news to a client that has none";
  EXPECT_EQ(std::get<PlaybackMessage>(first[0]).refusal, "viewers may not");
  EXPECT_TRUE(std::holds_alternative<MarksMessage>(first[1]));
  delta.playback->moment = 6;
  EXPECT_TRUE(serve().empty()) << "the replay's own pace is no news";
  const auto full = serve(true);
  ASSERT_EQ(full.size(), 1U);
  EXPECT_EQ(std::get<PlaybackMessage>(full[0]).moment, 6U);
  delta.playback->playing = false;
  ASSERT_EQ(serve().size(), 1U);
  EXPECT_TRUE(serve().empty());
}

TEST_F(ReplayNewsTest, events_and_cursors_come_when_the_client_has_caught_up) {
  EXPECT_EQ(serve(false, false).size(), 1U);
  EXPECT_EQ(serve().size(), 1U) << "the marks";
  auto cursors = std::make_shared<RecordedCursorsMessage>();
  cursors->cursors.push_back({3, "Ann", {}, {}});
  delta.cursors = cursors;
  EXPECT_TRUE(serve(false, false).empty());
  const auto late = serve();
  ASSERT_EQ(late.size(), 1U);
  EXPECT_EQ(std::get<RecordedCursorsMessage>(late[0]), *cursors);
  delta.cursors = std::make_shared<const RecordedCursorsMessage>();
  EXPECT_EQ(serve().size(), 1U) << "that all have left is news";
}

TEST(Outlet, counts_what_is_sent_and_a_slow_link_has_its_room_alone) {
  Outlet outlet(7);
  ServedPart part;
  const SharedBytes bytes = share(ResetMessage{});
  const auto fill = [&] {
    outlet.send(bytes, part);
    return outlet.has_room();
  };
  outlet.begin({0, limits::outbox_soft_bytes});
  EXPECT_FALSE(outlet.is_slow());
  for (size_t i = 0; i < limits::outbox_soft_bytes; ++i) ASSERT_TRUE(fill()) << "budgets bound a fast link";
  outlet.begin({0, 2 * bytes->size() + 2});
  EXPECT_TRUE(outlet.is_slow());
  EXPECT_TRUE(fill());
  EXPECT_FALSE(fill());
  EXPECT_EQ(part.out.size(), limits::outbox_soft_bytes + 2);
  EXPECT_EQ(part.out.back().session, 7U);
  EXPECT_EQ(outlet.sent_bytes(), part.out.size() * bytes->size());
  EXPECT_EQ(part.stats.sent_bytes, outlet.sent_bytes());
}

}  // namespace
}  // namespace scree
