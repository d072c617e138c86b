// A publisher whose chunks are out of memory: what a client wants is read first, and comes as if it had never
// been out.
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

/// A file that answers when it is told to.
class SlowSupply final : public ChunkSupply {
 public:
  explicit SlowSupply(Field& field) : field_(field) {}
  size_t bricks_max() override { return bricks; }
  Tick saved_tick() override { return saved; }
  bool has_room() override { return asked.size() < room; }
  void ask(ChunkCoord chunk) override { asked.insert(chunk); }
  std::vector<SuppliedChunk> collect(size_t) override {
    std::vector<SuppliedChunk> chunks;
    if (!answers) return chunks;
    for (const ChunkCoord chunk : std::exchange(asked, {})) {
      SuppliedChunk& one = chunks.emplace_back(SuppliedChunk{chunk, {}});
      for (const BrickCoord brick : field_.edited_bricks(chunk))
        one.bricks.push_back({brick, field_.brick(brick), field_.materials(brick)});
      if (lies) one.bricks.pop_back();
      ++read;
    }
    return chunks;
  }

  size_t bricks = 0;
  Tick saved = 0;
  size_t room = SIZE_MAX;
  bool answers = true, lies = false;
  std::set<ChunkCoord> asked;
  size_t read = 0;

 private:
  Field& field_;
};

class PublisherPagingTest : public PublisherTest {
 protected:
  PublisherPagingTest()
      : supply(std::make_shared<SlowSupply>(source.field())),
        paged(PublisherConfig{.terrain = flat_terrain, .chunks = supply}, workers) {}

  void play(const std::vector<Operation>& operations = {}) {
    TickDelta delta = *source.step(operations);
    std::set<ChunkCoord> chunks;
    for (const BrickState& brick : delta.bricks) chunks.insert(chunk_of(brick.coord));
    for (const ChunkCoord chunk : chunks) {
      uint64_t edited = 0;
      for (const BrickCoord brick : source.field().edited_bricks(chunk))
        edited |= uint64_t{1} << index_in_chunk(brick);
      delta.chunks.push_back({chunk, source.field().chunk_hash(chunk), edited});
    }
    receive(paged.publish(delta, [](uint64_t) { return Backlog(); }));
  }
  void carve_rows() {
    for (int i = 0; i < 12; ++i) play({source.carve({4.0F * static_cast<float>(i), 0.0F, 0.0F}, 1.5F, 3)});
  }
  void join_paged(uint64_t id) {
    paged.join(id, {20.0F, 2.0F, 0.0F}, 64.0F, operation_kinds);
    followers.try_emplace(id);
  }

  std::shared_ptr<SlowSupply> supply;
  Publisher paged;
};

TEST_F(PublisherPagingTest, what_is_not_saved_stays_and_what_is_goes) {
  carve_rows();
  EXPECT_EQ(paged.state().bricks_in(), source.field().edited_brick_count());
  supply->saved = source.tick() - 4;
  play();
  EXPECT_LT(paged.state().bricks_in(), source.field().edited_brick_count());
  EXPECT_GT(paged.state().bricks_in(), 0U);
  supply->saved = source.tick();
  play();
  EXPECT_EQ(paged.state().bricks_in(), 0U);
  EXPECT_EQ(paged.state().chunks().size(), source.field().edited_chunks().size());
}

TEST_F(PublisherPagingTest, a_joiner_gets_chunks_when_they_are_read_and_operations_meanwhile) {
  carve_rows();
  supply->saved = source.tick();
  play();
  ASSERT_EQ(paged.state().bricks_in(), 0U);
  supply->answers = false;
  join_paged(session);
  for (int i = 0; i < 10; ++i) play();
  EXPECT_EQ(followers.at(session).chunks, 0U) << "nobody waits, and nothing is made up";
  EXPECT_FALSE(supply->asked.empty());
  play({source.carve({6.0F, 0.0F, 0.0F}, 1.5F, 2)});  // a chunk that is out changes
  supply->answers = supply->lies = true;
  for (int i = 0; i < 10; ++i) play();
  supply->lies = false;
  supply->bricks = 100000;
  for (int i = 0; i < 60; ++i) play();
  EXPECT_GT(supply->read, 0U);
  expect_whole_field_equal(session);
  supply->bricks = 0;
  supply->saved = source.tick();
  play();
  EXPECT_EQ(paged.state().bricks_in(), 0U);
  play({source.carve({2.0F, -1.0F, 0.0F}, 1.5F, 2)});
  for (int i = 0; i < 10; ++i) play();
  expect_whole_field_equal(session);
}

TEST(EncodeCache, forgets_chunks_at_the_next_tick_when_they_are_too_many_bytes) {
  EncodeCache cache;
  Random random(3);
  std::vector<PublishedChunk> chunks(300);
  size_t bytes = 0;
  const auto encoded = [&](int i) { return cache.chunk({i, 0, 0}, chunks[static_cast<size_t>(i)]); };
  for (int i = 0; i < 300; ++i) {
    PublishedChunk& chunk = chunks[static_cast<size_t>(i)];
    chunk.version = 1;
    for (int index = 0; index < static_cast<int>(chunk_brick_count); ++index) {
      Brick brick;
      for (Code& code : brick.codes) code = static_cast<Code>(random.next() % 255 - 127);
      const BrickCoord coord = brick_in_chunk({i, 0, 0}, index);
      chunk.bricks[coord] = {coord, std::make_shared<const Brick>(brick), brick_hash(coord, brick, {}), {}};
      chunk.hash += chunk.bricks[coord].hash;
      chunk.edited |= uint64_t{1} << index;
    }
    bytes += encoded(i)->size();
    if (i == 99) {
      cache.start_tick();
      EXPECT_EQ(cache.chunk({0, 0, 0}, chunks[0]), encoded(0)) << "there is room for them";
    }
  }
  ASSERT_GT(bytes, limits::encoded_chunk_bytes_max);
  const SharedBytes first = encoded(0);
  EXPECT_EQ(encoded(0), first);
  cache.start_tick();
  EXPECT_NE(encoded(0), first);
  EXPECT_EQ(*encoded(0), *first);
}

}  // namespace
}  // namespace scree
