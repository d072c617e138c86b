// Seeds: as many as were asked for, and never two in one place.
#include "shared/fracture/seeds.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <set>

#include "shared/field/edit.h"

namespace scree {
namespace {

constexpr VoxelBox box_of_the_ball{{-16, -16, -16}, {16, 16, 16}};
const glm::vec3 impact(0.0F, 12.0F, 0.0F);

Window ball() {
  return codes_of(sphere({0.0F, 0.0F, 0.0F}, 12.0F), box_of_the_ball);
}

TEST(seeds, no_two_of_any_pattern_are_nearer_than_a_voxel) {
  for (const SeedPattern pattern : drawn_patterns) {
    const std::vector<glm::vec3> seeds = scatter_seeds(ball(), pattern, 400, 3, impact);
    for (size_t i = 0; i < seeds.size(); ++i)
      for (size_t j = 0; j < i; ++j) ASSERT_GE(glm::distance(seeds[i], seeds[j]), 1.0F) << i << ' ' << j;
  }
}

TEST(seeds, there_are_as_many_as_asked_for_though_a_pattern_favours_few_places) {
  for (const SeedPattern pattern : drawn_patterns) {
    const size_t seeds = scatter_seeds(ball(), pattern, 128, 3, impact).size();
    const Flattened flattened = traits_of(pattern).flattened;
    const bool on_a_line =
        flattened == Flattened::xy || flattened == Flattened::xz || flattened == Flattened::yz;
    // A line of 24 voxels has no room for more.
    if (on_a_line)
      EXPECT_GE(seeds, 12U) << name_of(pattern);
    else
      EXPECT_GE(seeds, flattened == Flattened::none ? 128U : 100U) << name_of(pattern);
  }
}

TEST(seeds, splinters_run_along_the_grain_slabs_across_it_and_shards_through_the_thin_side) {
  const auto places = [](const Window& volume, SeedPattern pattern, int axis) {
    std::set<float> at;
    for (const glm::vec3& seed : scatter_seeds(volume, pattern, 40, 3, impact)) at.insert(seed[axis]);
    return at.size();
  };
  EXPECT_EQ(places(ball(), SeedPattern::grain_x, 0), 1U);
  EXPECT_GT(places(ball(), SeedPattern::grain_x, 1), 20U);
  EXPECT_GT(places(ball(), SeedPattern::slabs_y, 1), 10U);
  EXPECT_EQ(places(ball(), SeedPattern::slabs_y, 0), 1U);
  EXPECT_EQ(places(ball(), SeedPattern::slabs_y, 2), 1U);
  const Window pane = codes_of(box({0.0F, 0.0F, 0.0F}, {10.0F, 10.0F, 1.5F}), box_of_the_ball);
  EXPECT_EQ(places(pane, SeedPattern::shards, 2), 1U);
  EXPECT_GT(places(pane, SeedPattern::shards, 0), 20U);
}

}  // namespace
}  // namespace scree
