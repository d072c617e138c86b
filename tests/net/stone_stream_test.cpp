// Stones where pieces merged, for clients that did not see it.
#include <gtest/gtest.h>

#include "server/world/stone_keeper.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

class StoneStreamTest : public PublisherTest {
 protected:
  static constexpr uint64_t early = 1, late = 2;

  void SetUp() override { publisher.begin(source.keyframe()); }
  void tick_of_stones(const std::vector<Operation>& operations = {}) {
    TickDelta delta = *source.step(operations);
    keeper.follow(source.field(), delta);
    deliver(delta);
  }
  void ticks_of_stones(int count) {
    for (int tick = 0; tick < count; ++tick) tick_of_stones();
  }
  void join_for_stones(uint64_t id, glm::vec3 eye_m = {0.0F, 2.0F, 0.0F}, float radius_m = 40.0F) {
    join(id, eye_m, radius_m);
    publisher.want_stones(id, true);
  }
  /// Pieces that merge each three metres beside the one before, in a row from the carve on.
  void merge_row(uint32_t count) {
    const PieceId first = 1 + static_cast<PieceId>(merged_);
    tick_of_stones({source.carve({0.0F, 0.0F, 0.5F * static_cast<float>(merged_)}, 1.5F, count)});
    std::vector<Operation> stamps;
    for (PieceId id = first; id < first + count; ++id) {
      if (!source.pieces().contains(id)) continue;
      source.move(id, {3.0F * static_cast<float>(id), 0.75F, 0.0F});
      stamps.emplace_back(source.stamp(id));
    }
    merged_ += count;
    ticks_of_stones(3);  // those who are there get the poses
    tick_of_stones(stamps);
  }
  std::set<PieceId> told(uint64_t id) {
    std::set<PieceId> ids;
    for (const StoneMessage& stone : followers.at(id).stones) EXPECT_TRUE(ids.insert(stone.id).second);
    return ids;
  }
  std::set<PieceId> kept() const {
    std::set<PieceId> ids;
    for (const SettledStone& stone : keeper.value()) ids.insert(stone.id);
    return ids;
  }

  StoneKeeper keeper;
  uint32_t merged_ = 0;
};

TEST_F(StoneStreamTest, who_joins_late_gets_the_stones_and_who_saw_the_merge_does_not) {
  join_for_stones(early);
  join(3, {0.0F, 2.0F, 0.0F}, 40.0F);
  ticks_of_stones(3);
  merge_row(6);
  ASSERT_GE(kept().size(), 3U);
  join_for_stones(late);
  ticks_of_stones(30);
  EXPECT_EQ(told(late), kept());
  EXPECT_TRUE(followers.at(early).stones.empty()) << "it finds them by itself";
  EXPECT_TRUE(followers.at(3).stones.empty()) << "it did not ask for any";
  const StoneMessage& first = followers.at(late).stones.front();
  const std::vector<SettledStone> all = keeper.value();
  const auto same = std::ranges::find(all, first.id, &SettledStone::id);
  EXPECT_EQ(first.pose, same->pose);
  EXPECT_EQ(first.lies, same->lies);
  EXPECT_EQ(first.volume.window.codes, same->volume->window.codes);
}

TEST_F(StoneStreamTest, a_stone_comes_after_the_ground_that_it_lies_in) {
  merge_row(6);
  join_for_stones(late);
  size_t told_before_ground = 0;
  for (int tick = 0; tick < 30; ++tick) {
    tick_of_stones();
    for (const StoneMessage& stone : followers.at(late).stones)
      if (!publisher.view(late)->held().contains(publisher.state().stones().all().at(stone.id).chunk))
        ++told_before_ground;
  }
  EXPECT_EQ(told_before_ground, 0U);
  EXPECT_EQ(told(late), kept());
}

TEST_F(StoneStreamTest, what_ended_before_is_not_told) {
  merge_row(6);
  const std::set<PieceId> before = kept();
  const glm::vec3 at_m = dequantise(keeper.value().front().pose).position_m;
  tick_of_stones({source.carve(at_m, 1.0F, 1)});
  ASSERT_LT(kept().size(), before.size());
  join_for_stones(late);
  ticks_of_stones(30);
  EXPECT_EQ(told(late), kept());
}

TEST_F(StoneStreamTest, who_comes_back_to_a_place_gets_its_stones_again) {
  join_for_stones(early);
  ticks_of_stones(3);
  merge_row(3);
  ASSERT_FALSE(kept().empty());
  EXPECT_TRUE(followers.at(early).stones.empty());
  publisher.set_interest(early, {200.0F, 2.0F, 0.0F}, 40.0F);
  ticks_of_stones(30);
  ASSERT_GT(followers.at(early).drops, 0U);
  publisher.set_interest(early, {0.0F, 2.0F, 0.0F}, 40.0F);
  ticks_of_stones(30);
  EXPECT_EQ(told(early), kept());
}

TEST_F(StoneStreamTest, a_client_that_lacked_the_piece_is_told_of_its_stone) {
  merge_row(3);
  join_for_stones(late, {0.0F, 2.0F, 0.0F}, 40.0F);
  ticks_of_stones(30);
  const size_t at_first = told(late).size();
  backlog_bytes = 0;
  publisher.set_interest(late, {200.0F, 2.0F, 0.0F}, 40.0F);
  ticks_of_stones(30);
  merge_row(3);
  publisher.set_interest(late, {0.0F, 2.0F, 0.0F}, 40.0F);
  followers.at(late).stones.clear();
  ticks_of_stones(30);
  EXPECT_EQ(told(late), kept());
  EXPECT_GT(kept().size(), at_first);
}

TEST_F(StoneStreamTest, a_reset_client_gets_all_again) {
  merge_row(6);
  join_for_stones(early);
  ticks_of_stones(30);
  EXPECT_EQ(told(early), kept());
  followers.at(early).stones.clear();
  backlog_bytes = limits::outbox_resync_bytes + 1;
  ticks_of_stones(2);
  backlog_bytes = 0;
  ticks_of_stones(30);
  ASSERT_EQ(followers.at(early).resets, 1U);
  EXPECT_EQ(told(early), kept());
}

TEST_F(StoneStreamTest, bytes_of_stones_are_bounded_by_the_tick) {
  for (int row = 0; row < 4; ++row) merge_row(12);
  ASSERT_GE(kept().size(), 20U);
  join_for_stones(late, {0.0F, 2.0F, 12.0F}, 200.0F);
  uint64_t before = publisher.stats().stone_bytes;
  int64_t largest = 0, ticks = 0;
  while (told(late).size() < kept().size() && ++ticks < 600) {
    tick_of_stones();
    largest = std::max(largest, static_cast<int64_t>(publisher.stats().stone_bytes - before));
    before = publisher.stats().stone_bytes;
  }
  EXPECT_EQ(told(late), kept());
  EXPECT_LE(largest, 3 * limits::stone_bytes_per_tick + 4096) << "a stone more than the room";
  EXPECT_GE(ticks * limits::stone_bytes_per_tick + 16384, static_cast<int64_t>(before));
}

}  // namespace
}  // namespace scree
