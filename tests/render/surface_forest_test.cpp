// The octrees that terrain is meshed by: fine about the eye, and at rest when the eye is.
#include "client/render/meshing/surface_forest.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

const ForestShape shape{4, 4.0F, 16.0F, 100.0F, 0.0F, 8.0F};

/// Grows until there is nothing to do; how many steps that took.
int settle(SurfaceForest& forest, glm::vec3 eye_m) {
  int steps = 0;
  while (!forest.grow(eye_m, 8).empty() && steps < 10000) ++steps;
  return steps;
}

TEST(surface_forest, is_finest_about_the_eye_and_comes_to_rest) {
  SurfaceForest forest(shape);
  EXPECT_GT(settle(forest, {2.0F, 2.0F, 2.0F}), 0);
  EXPECT_EQ(settle(forest, {2.0F, 2.0F, 2.0F}), 0);
  for (int x = -3; x <= 3; ++x)
    for (int z = -3; z <= 3; ++z) EXPECT_TRUE(forest.is_leaf({0, {x, 0, z}})) << x << ' ' << z;
  EXPECT_FALSE(forest.is_leaf({0, {12, 0, 0}}));
}

TEST(surface_forest, pacing_to_and_fro_builds_nothing_again) {
  // Wherever the eye stands, some border between two levels is near.
  for (float start_m = 0.0F; start_m < 8.0F; start_m += 1.0F) {
    SurfaceForest forest(shape);
    const glm::vec3 here(start_m, 2.0F, 2.0F), there(start_m + 1.5F, 2.0F, 2.0F);
    settle(forest, here);
    settle(forest, there);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(settle(forest, i % 2 == 0 ? here : there), 0) << start_m << " m";
  }
}

}  // namespace
}  // namespace scree
