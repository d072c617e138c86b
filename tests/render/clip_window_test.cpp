// What a ray may skip, against a search of every brick.
#include "client/render/bricks/clip_window.h"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>

#include "shared/base/random.h"

namespace scree {
namespace {

constexpr int side = 16;

/// A window, and in plain form what it should hold.
class ClipWindowTest : public testing::Test {
 protected:
  BrickCoord any_brick(Random& random) const {
    const auto below = [&](int n) { return static_cast<int>(random.next() % static_cast<uint32_t>(n)); };
    return window_.origin() + BrickCoord{below(side), below(side / 2), below(side)};
  }
  void set(BrickCoord brick, uint32_t kind) {
    const uint32_t field = kind == 1 ? clip_empty : ClipEntry::packed(kind, AtlasSlot{7, 8, 9});
    window_.set(brick, {field, 0, 0});
    kinds_[brick] = kind;
  }
  void fill(Random& random, int percent_stored) {
    for_each([&](BrickCoord brick) {
      const bool stored = static_cast<int>(random.next() % 100U) < percent_stored;
      set(brick, stored ? ClipEntry::stored : 1U);
    });
  }
  template <typename F>
  void for_each(F&& f) const {
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side / 2; ++y)
        for (int z = 0; z < side; ++z) f(window_.origin() + BrickCoord{x, y, z});
  }
  uint32_t kind_of(BrickCoord brick) const {
    const auto found = kinds_.find(brick);
    return found == kinds_.end() ? uint32_t{ClipEntry::unloaded} : found->second;
  }
  int distance_of(BrickCoord brick) const {
    int least = empty_distance_max;
    for_each([&](BrickCoord other) {
      if (kind_of(other) == 1) return;
      const BrickCoord d = other - brick;
      least = std::min(least, std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
    });
    return least;
  }
  void expect_exact() const {
    for_each([&](BrickCoord brick) {
      const uint32_t kind = kind_of(brick);
      const uint32_t wanted = kind == 1 ? static_cast<uint32_t>(distance_of(brick)) : kind;
      ASSERT_EQ(window_.at(brick).kind(), wanted) << brick.x << ' ' << brick.y << ' ' << brick.z;
    });
  }
  void move_to(BrickCoord origin) {
    window_.move_to(origin, [this](const ClipEntry& entry) { ++left_[entry.kind()]; });
    std::erase_if(kinds_, [&](const auto& entry) { return !window_.holds(entry.first); });
  }

  ClipWindow window_{side};
  std::map<BrickCoord, uint32_t> kinds_;
  std::map<uint32_t, int> left_;
};

TEST_F(ClipWindowTest, distances_are_exact_after_any_edits) {
  Random random(3);
  move_to({-5, -3, 40});
  fill(random, 2);
  window_.settle();
  expect_exact();
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 3; ++i) set(any_brick(random), random.next() % 2 == 0 ? ClipEntry::stored : 1U);
    window_.settle();
    ASSERT_NO_FATAL_FAILURE(expect_exact()) << "round " << round;
  }
}

TEST_F(ClipWindowTest, distances_are_exact_after_a_move) {
  Random random(5);
  move_to({-8, -4, -8});
  fill(random, 1);
  window_.settle();
  for (const BrickCoord to : {BrickCoord{-4, -4, -8}, BrickCoord{-4, 0, -4}, BrickCoord{100, 0, 0}}) {
    move_to(to);
    window_.settle();
    ASSERT_NO_FATAL_FAILURE(expect_exact());
    for_each([&](BrickCoord brick) {
      if (kind_of(brick) == ClipEntry::unloaded) set(brick, random.next() % 90 == 0 ? ClipEntry::stored : 1U);
    });
    window_.settle();
    ASSERT_NO_FATAL_FAILURE(expect_exact());
  }
}

TEST_F(ClipWindowTest, what_falls_out_is_handed_back_once) {
  Random random(7);
  move_to({0, 0, 0});
  fill(random, 50);
  const auto stored =
      std::ranges::count_if(kinds_, [](const auto& e) { return e.second == ClipEntry::stored; });
  move_to({4, 0, 0});
  const int first = left_[ClipEntry::stored];
  EXPECT_GT(first, 0);
  EXPECT_LT(first, stored);
  move_to({1000, 0, 0});
  EXPECT_EQ(left_[ClipEntry::stored], stored);
}

TEST_F(ClipWindowTest, only_what_changed_is_uploaded_again) {
  Random random(9);
  move_to({0, 0, 0});
  fill(random, 100);
  window_.settle();
  int slabs = 0;
  window_.drain_changed_slabs([&](int, const ClipEntry*) { ++slabs; });
  EXPECT_EQ(slabs, side);
  window_.set({5, 2, 3}, {ClipEntry::packed(ClipEntry::stored, AtlasSlot{1, 1, 1}), 0, 0});
  window_.settle();
  std::vector<int> changed;
  window_.drain_changed_slabs([&](int x, const ClipEntry*) { changed.push_back(x); });
  EXPECT_EQ(changed, std::vector<int>{5});
}

TEST(ClipEntry, has_slots_for_the_field_as_it_was_and_for_looks) {
  const AtlasSlot slot{27, 5, 1};
  for (const uint32_t kind : {ClipEntry::same, ClipEntry::mixed, ClipEntry::air, ClipEntry::rock}) {
    const ClipEntry entry{ClipEntry::packed(ClipEntry::stored, slot), ClipEntry::packed(kind, slot),
                          ClipEntry::packed(ClipEntry::looks_mixed, slot)};
    EXPECT_EQ(entry.kind(), ClipEntry::stored);
    EXPECT_EQ(entry.has_before_slot(), kind == ClipEntry::mixed);
    EXPECT_EQ(ClipEntry::slot_of(entry.before), slot);
    EXPECT_TRUE(entry.has_looks_slot());
    EXPECT_EQ(ClipEntry::slot_of(entry.looks), slot);
  }
  EXPECT_FALSE((ClipEntry{0, 0, 0xFFFF}.has_looks_slot())) << "all of one look";
}

TEST_F(ClipWindowTest, a_brick_that_stays_empty_keeps_what_else_its_entry_says) {
  window_.move_to({0, 0, 0}, [](const ClipEntry&) {});
  window_.set({3, 2, 3}, {clip_empty, 0, 7});
  window_.settle();
  EXPECT_EQ(window_.at({3, 2, 3}).looks, 7U);
}

}  // namespace
}  // namespace scree
