// The duties of a NetServer's host: the world before the first tick, and every later tick in order. A breach
// ends the process with a message, and never empties a client's world.
#include <gtest/gtest.h>
#include <map>

#include "server/publish/client_view.h"
#include "tests/support/net_server_fixture.h"

namespace scree {
namespace {

class HostContract : public NetServerTest {
 protected:
  // A process with threads is not to be forked: the test that dies begins anew.
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  std::unique_ptr<RawClient> join() {
    auto client = std::make_unique<RawClient>(server->port());
    EXPECT_TRUE(client->send(hello()));
    EXPECT_TRUE(client->receive_as<WelcomeMessage>().has_value());
    return client;
  }
};

TEST_F(HostContract, a_tick_that_is_not_published_is_an_error) {
  start();
  tick({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 4)});
  static_cast<void>(source.step());  // nobody publishes it
  const auto third = source.step();
  EXPECT_DEATH(server->publish(third), "CHECK failed: delta->tick == .* \\(3, 2\\): publish every tick");
}

TEST_F(HostContract, a_tick_that_is_published_twice_is_an_error) {
  start();
  const auto first = source.step();
  server->publish(first);
  EXPECT_DEATH(server->publish(first), "\\(1, 2\\): publish every tick");
}

TEST_F(HostContract, the_first_tick_follows_the_keyframe) {
  for (int i = 0; i < 5; ++i) static_cast<void>(source.step());
  start();
  static_cast<void>(source.step());
  const auto seventh = source.step();
  EXPECT_DEATH(server->publish(seventh), "\\(7, 6\\): publish every tick");
}

TEST_F(HostContract, a_replay_may_jump_and_its_clients_start_again) {
  start([](NetConfig& config) { config.replay = true; });
  tick({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 4)});
  ASSERT_TRUE(witness->receive_as<FrameMessage>().has_value());
  auto later = std::make_shared<TickDelta>(source.keyframe());
  later->tick += 100;
  server->publish(later);
  EXPECT_TRUE(witness->receive_as<ResetMessage>().has_value());
}

TEST_F(HostContract, a_client_gets_the_world_that_was_there_before_the_server) {
  static_cast<void>(source.step({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 4)}));
  static_cast<void>(source.step());
  start();
  const auto client = join();
  tick();
  std::map<ChunkCoord, uint64_t> hashes;
  while (hashes.size() < source.field().edited_chunks().size()) {
    const auto chunk = client->receive_as<ChunkMessage>();
    ASSERT_TRUE(chunk.has_value());
    hashes[chunk->chunk] = chunk->hash;
    if (source.tick() < 60) tick();
  }
  for (const auto& [chunk, hash] : hashes) EXPECT_EQ(hash, source.field().chunk_hash(chunk));
  EXPECT_FALSE(hashes.empty());
}

/// The changes of ticks, made as the publisher makes them.
class TickChangesTest : public ::testing::Test {
 protected:
  TickChanges changes_of(const TickDelta& delta) {
    const ChunkSet unedited = unedited_before(delta, state);
    state.apply(delta);
    return {delta, unedited, state, motions, flat_terrain};
  }

  TickSource source{flat_terrain};
  PublishedState state;
  Motions motions{motion_rules(60, 3), flat_terrain.voxel_size_m};
};

TEST_F(TickChangesTest, a_chunk_is_new_in_the_tick_that_edits_it_first_and_in_no_other) {
  const auto first = source.step({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 1)});
  const TickChanges opened = changes_of(*first);
  EXPECT_EQ(opened.fresh.size(), source.field().edited_chunks().size());
  ASSERT_EQ(opened.opens.size(), 1U);
  EXPECT_EQ(opened.opens[0].size(), opened.fresh.size());
  EXPECT_TRUE(opened.needs[0].empty());
  const auto second = source.step({source.carve({0.0F, 0.0F, 0.0F}, 1.5F, 1)});
  const TickChanges again = changes_of(*second);
  EXPECT_FALSE(again.bricks.empty());
  EXPECT_TRUE(again.fresh.empty());
  EXPECT_TRUE(again.opens[0].empty());
  EXPECT_EQ(again.needs[0].size(), opened.fresh.size());
}

TEST_F(TickChangesTest, the_states_before_and_after_a_tick_are_not_mistaken_for_each_other) {
  const auto first = source.step({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 1)});
  const auto second = source.step();
  const ChunkSet unedited = unedited_before(*first, state);
  EXPECT_DEATH((TickChanges{*first, unedited, state, motions, flat_terrain}), "the one after the tick");
  state.apply(*first);
  EXPECT_DEATH(static_cast<void>(unedited_before(*first, state)), "the one before the tick");
  EXPECT_EQ(unedited_before(*second, state).size(), 0U);
}

}  // namespace
}  // namespace scree
