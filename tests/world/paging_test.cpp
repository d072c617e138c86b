// A world whose terrain is out of memory between any two ticks goes the same way as one that has it all.
#include <gtest/gtest.h>

#include "bench/support/scenes.h"
#include "server/formats/world_codec.h"
#include "server/world/published_state.h"
#include "server/world/world.h"
#include "server/world/world_snapshot.h"
#include "tests/support/chunk_shelf.h"

namespace scree {
namespace {

std::vector<Command> blows_of(const TerrainSource& terrain, Tick tick) {
  if (tick % 6 != 0 || tick > 60) return {};
  const float x = -5.0F + static_cast<float>(tick * 5 % 11);
  return {
      {1, static_cast<uint32_t>(tick), blow_at(terrain, x, 0.5F * x, 1.5F, 20, static_cast<uint32_t>(tick))}};
}

TEST(paged_world, goes_the_same_way_with_all_terrain_out_after_every_tick) {
  WorldConfig config;
  config.methods.support = true;
  World whole(config), paged(config);
  ChunkShelf shelf;
  paged.paging().page_by(shelf.reader());
  PublishedState published;
  for (Tick tick = 1; tick <= 150; ++tick) {
    const std::vector<Command> commands = blows_of(config.terrain, tick);
    const auto a = whole.step(commands), b = paged.step(commands);
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
    ASSERT_EQ(a->ledger, b->ledger);
    published.apply(*b);
    for (const ChunkState& chunk : b->chunks) {
      EXPECT_EQ(chunk.hash, whole.field().chunk_hash(chunk.chunk));
      EXPECT_EQ(published.chunks().at(chunk.chunk).hash, chunk.hash);
    }
    shelf.page_out_all(paged.paging());
    const std::vector<ChunkCoord> in(published.chunks_in().begin(), published.chunks_in().end());
    for (const ChunkCoord chunk : in) published.page_out(chunk);
  }
  EXPECT_GT(shelf.reads, 100U);
  EXPECT_EQ(published.bricks_in(), 0U);
  EXPECT_EQ(paged.measure_terrain(), whole.measure_terrain());
  EXPECT_EQ(paged.field().chunks_in().size(), 0U) << "weighing needs no bricks";
  EXPECT_EQ(encode(paged.snapshot()), encode(whole.snapshot()));
  EXPECT_EQ(paged.field().chunks_in().size(), 0U);
}

TEST(paged_world, is_restored_with_as_much_terrain_as_there_is_memory_for) {
  WorldConfig config;
  World world(config);
  for (Tick tick = 1; tick <= 80; ++tick) world.step(blows_of(config.terrain, tick));
  ChunkShelf shelf;
  for (const ChunkCoord chunk : world.field().edited_chunks()) shelf.copy(world.field(), chunk);
  WorldSnapshot value = world.snapshot();
  value.bricks.clear();
  PagedTerrain terrain;
  terrain.read = shelf.reader();
  terrain.bricks_max = 40;
  terrain.each = [&](const PagedTerrain::Visit& visit) -> Result<void> {
    for (const auto& [chunk, bricks] : shelf.chunks) TRY(visit(chunk, bricks));
    return {};
  };
  const auto restored = World::restore(value, terrain, 1, {});
  ASSERT_TRUE(restored.has_value()) << restored.error().message;
  EXPECT_LE((*restored)->field().bricks_in(), 40U + 64U);
  EXPECT_GT((*restored)->field().chunks_out(), 0U);
  const auto other = World::restore(world.snapshot());
  ASSERT_TRUE(other.has_value());
  for (int tick = 0; tick < 60; ++tick)
    ASSERT_EQ((*restored)->step({})->state_hash, (*other)->step({})->state_hash);
  // What a file says is not believed.
  shelf.chunks.rbegin()->second.back().brick.codes[0] ^= 1;
  EXPECT_FALSE(World::restore(value, terrain, 1, {}).has_value());
}

TEST(published_paging, what_changed_while_a_chunk_was_out_wins_over_what_is_read) {
  World world{WorldConfig()};
  ChunkShelf shelf;
  world.paging().page_by(shelf.reader());
  PublishedState published;
  const auto play = [&](Tick from, Tick to) {
    for (Tick tick = from; tick <= to; ++tick)
      published.apply(*world.step(blows_of(world.config().terrain, tick)));
  };
  play(1, 30);
  for (const ChunkCoord chunk : world.field().edited_chunks()) shelf.copy(world.field(), chunk);
  for (const auto& [chunk, bricks] : shelf.chunks) published.page_out(chunk);
  play(31, 70);
  size_t changed = 0;
  for (const auto& [chunk, bricks] : shelf.chunks) {
    const PublishedChunk& known = published.chunks().at(chunk);
    if (known.is_whole()) continue;  // all of it changed
    changed += known.bricks.empty() ? 0 : 1;
    std::vector<BrickPatch> lies = bricks;
    lies.back().brick.codes[0] ^= 1;
    if (known.bricks.empty()) {
      EXPECT_FALSE(published.page_in(chunk, lies));
    }
    ASSERT_TRUE(published.page_in(chunk, bricks));
    EXPECT_TRUE(known.is_whole());
    EXPECT_EQ(known.hash, world.field().chunk_hash(chunk));
  }
  EXPECT_GT(changed, 0U);
  EXPECT_EQ(published.as_delta().bricks.size(), world.field().edited_brick_count());
}

}  // namespace
}  // namespace scree
