// A client and a server of which each takes the other for one of a later release: messages of unknown kinds
// and unknown fields come both ways, through a real server on loopback.
#include <gtest/gtest.h>

#include "tests/support/flat_terrain.h"
#include "tests/support/growing_relay.h"
#include "tests/support/session_support.h"

namespace scree {
namespace {

LiveConfig flat() {
  LiveConfig config;
  config.world.terrain = flat_terrain;
  return config;
}

CarveMessage carve(uint32_t request) {
  CarveRequest carve;
  carve.shape = sphere({static_cast<float>(request), -0.4F, 0.0F}, 1.0F);
  carve.seeds = 4;
  carve.random_seed = request;
  return carve_message(carve, request);
}

TEST(Growth, a_later_release_talks_with_this_one_and_their_fields_are_equal) {
  LoopbackSession session(flat());
  ASSERT_EQ(session.failure, "");
  const GrowingRelay relay(session.server().port());
  SessionClient client(relay.port(), {0.0F, 2.0F, 0.0F}, 64.0F);
  ASSERT_EQ(client.failure, "");
  constexpr uint32_t carves = 6;
  constexpr int ticks_max = 300;
  for (uint32_t request = 1; request <= carves; ++request) client.send(carve(request));
  for (int i = 0; i < ticks_max && client.replies.size() < carves; ++i) {
    ASSERT_TRUE(session.step()) << session.failure;
    ASSERT_TRUE(client.follow_to(session.tick())) << client.failure;
    ASSERT_EQ(client.mirror().field().hash(), session.field().hash());
  }
  ASSERT_EQ(client.replies.size(), carves);
  for (const auto& [request, reply] : client.replies) EXPECT_EQ(reply.refusal, "");
  EXPECT_GT(client.mirror().counters().checks, 0U);
  EXPECT_EQ(client.mirror().mismatches(), 0U);
  EXPECT_GT(client.mirror().counters().frames, 0U);
  EXPECT_GE(client.client().counters().messages_unknown, client.mirror().counters().frames);
  EXPECT_GE(session.server().report().net.messages_unknown, carves);
}

}  // namespace
}  // namespace scree
