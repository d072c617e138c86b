// What a tick gathers beside the last step: impacts of its earlier steps, and changes that bodies are not
// told yet.
#include "server/bodies/tick_blows.h"

#include <gtest/gtest.h>

#include "server/bodies/pending_changes.h"

namespace scree {
namespace {

BodyImpact impact(PieceId id, float impulse_n_s) {
  BodyImpact impact;
  impact.id = id;
  impact.impulse_n_s = impulse_n_s;
  return impact;
}

TEST(TickBlows, the_strongest_of_each_body_stays_and_weak_ones_and_bodies_that_are_gone_do_not_count) {
  TickBlows blows;
  blows.add({impact(1, 5.0F), impact(2, 5.0F), impact(4, 5.0F), impact(5, 0.5F)});
  blows.add({impact(1, 9.0F), impact(3, 5.0F)});
  std::vector<BodyImpact> impacts{impact(2, 7.0F), impact(3, 4.0F)};
  blows.merge_into(impacts, [](PieceId id) -> std::optional<float> {
    if (id == 4) return std::nullopt;
    return 1.0F;
  });
  ASSERT_EQ(impacts.size(), 3U);
  const float wanted[] = {9.0F, 7.0F, 5.0F};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(impacts[i].id, i + 1);
    EXPECT_EQ(impacts[i].impulse_n_s, wanted[i]);
  }
  blows.clear();
  impacts.clear();
  blows.merge_into(impacts, [](PieceId) { return 0.0F; });
  EXPECT_TRUE(impacts.empty());
}

TEST(PendingChanges, wake_what_meets_a_grown_box_or_the_place_of_a_body_that_is_gone) {
  PendingChanges pending;
  EXPECT_TRUE(pending.empty());
  pending.add(VoxelBox{{0, 0, 0}, {8, 8, 8}});
  pending.add(Bounds{{10.0F, 0.0F, 0.0F}, {11.0F, 1.0F, 1.0F}});
  const auto wakes = [&](float x) {
    const Bounds body{{x, 0.0F, 0.0F}, {x + 0.1F, 1.0F, 1.0F}};
    return std::ranges::any_of(pending.waking(0.25F), [&](const Bounds& near) { return meet(near, body); });
  };
  EXPECT_TRUE(wakes(2.2F)) << "within a voxel of the box";
  EXPECT_FALSE(wakes(2.3F));
  EXPECT_TRUE(wakes(10.5F));
  MotionValue value;
  pending.store(value);
  PendingChanges again;
  again.restore(value);
  EXPECT_EQ(again.boxes(), pending.boxes());
  EXPECT_EQ(again.waking(0.25F).size(), 2U);
  pending.clear();
  EXPECT_TRUE(pending.empty());
}

}  // namespace
}  // namespace scree
