// The duties of a World's host: the terrain is for reading, and one thread at a time runs the world.
#include <gtest/gtest.h>
#include <thread>

#include "bench/support/scenes.h"
#include "server/world/world.h"
#include "server/world/world_snapshot.h"
#include "tests/support/chunk_shelf.h"
#include "tests/support/tick_source.h"

namespace scree {
namespace {

template <typename Owner>
concept GivesFieldForWriting = requires(Owner& owner, const Brick& brick) {
  owner.field().set_brick(BrickCoord{}, brick);
};
static_assert(GivesFieldForWriting<TickSource>);
static_assert(!GivesFieldForWriting<World>);

std::vector<Command> blow_now_and_then(const TerrainSource& terrain, Tick tick) {
  if (tick % 10 != 1) return {};
  return {{1, static_cast<uint32_t>(tick),
           blow_at(terrain, static_cast<float>(tick % 7), 0.0F, 2.0F, 60, static_cast<uint32_t>(tick))}};
}

void run(World& world, Tick ticks, std::vector<uint64_t>& hashes) {
  for (Tick i = 0; i < ticks; ++i) {
    const auto delta = world.step(blow_now_and_then(world.config().terrain, world.tick() + 1));
    hashes.push_back(delta->state_hash);
  }
}

TEST(WorldContract, reading_the_terrain_changes_nothing_whatever_is_out_of_memory) {
  const WorldConfig config;
  World left_alone(config), looked_at(config);
  ChunkShelf shelf;
  looked_at.paging().page_by(shelf.reader());
  for (Tick tick = 1; tick <= 60; ++tick) {
    const std::vector<Command> commands = blow_now_and_then(config.terrain, tick);
    ASSERT_EQ(looked_at.step(commands)->state_hash, left_alone.step(commands)->state_hash) << tick;
    shelf.page_out_all(looked_at.paging());
    const World& world = looked_at;
    const Window seen = gather(world.field(), VoxelBox{{-24, -40, -24}, {48, 40, 24}});
    EXPECT_EQ(seen.codes, gather(left_alone.field(), seen.box).codes);
  }
  EXPECT_GT(looked_at.field().page_waits(), 0U) << "what was read had to come in";
  const auto last = looked_at.step({});
  EXPECT_EQ(looked_at.measure_terrain(), last->ledger.terrain);
}

class HandedOver : public ::testing::TestWithParam<size_t> {};
INSTANTIATE_TEST_SUITE_P(Threads, HandedOver, ::testing::Values(1U, 3U));

TEST_P(HandedOver, a_world_goes_on_in_another_thread_the_same_way) {
  std::vector<uint64_t> alone, handed_over;
  World by_one(WorldConfig(), GetParam()), by_two(WorldConfig(), GetParam());
  run(by_one, 60, alone);
  run(by_two, 30, handed_over);
  by_two.release_thread();
  std::thread([&] {
    run(by_two, 20, handed_over);
    by_two.renew();
    by_two.release_thread();
  }).join();
  by_two.renew();
  run(by_two, 1, handed_over);
  EXPECT_EQ(std::vector(alone.begin(), alone.begin() + 50),
            std::vector(handed_over.begin(), handed_over.begin() + 50));
}

TEST_P(HandedOver, a_world_that_one_thread_restored_and_another_one_built_runs_in_a_third) {
  World built(WorldConfig(), GetParam());
  std::vector<uint64_t> hashes;
  run(built, 30, hashes);
  auto restored = World::restore(built.snapshot(), GetParam());
  ASSERT_TRUE(restored.has_value()) << restored.error().message;
  std::thread([&] { run(**restored, 5, hashes); }).join();
  EXPECT_EQ(hashes.size(), 35U);
}

TEST(WorldContract, two_threads_do_not_own_a_world) {
  World world{WorldConfig()};
  static_cast<void>(world.step({}));
  std::thread([&] {
    EXPECT_DEATH(static_cast<void>(world.step({})), "another thread owns this world");
    EXPECT_DEATH(world.renew(), "another thread owns this world");
    EXPECT_DEATH(world.release_thread(), "only the thread that owns a world can release it");
  }).join();
  static_cast<void>(world.step({}));
}

}  // namespace
}  // namespace scree
