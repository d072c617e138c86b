// Seeds: as many as were asked for, and never two in one place.
#include "shared/fracture/seeds.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

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
  for (const SeedPattern pattern : drawn_patterns)
    EXPECT_EQ(scatter_seeds(ball(), pattern, 128, 3, impact).size(), 128U);
}

}  // namespace
}  // namespace scree
