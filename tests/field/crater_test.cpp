// Craters: within their ball, rough, with flat faces, and distances that a kernel may trust.
#include "shared/field/crater.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "shared/field/edit.h"
#include "shared/field/mass.h"
#include "shared/field/voxel_vector.h"
#include "shared/field/window_sample.h"

namespace scree {
namespace {

const glm::vec3 crater_place(-3.3F, 40.7F, 12.9F);

/// Calls f(voxel, place in the window's codes) for every voxel but those of the outermost layer.
template <typename F>
void for_each_inner(const Window& window, F&& f) {
  const VoxelBox inner = window.box.grown(-1);
  for (int x = inner.lo.x; x < inner.hi.x; ++x)
    for (int y = inner.lo.y; y < inner.hi.y; ++y)
      for (int z = inner.lo.z; z < inner.hi.z; ++z) f(VoxelCoord{x, y, z}, window.index(x, y, z));
}

Window crater_of(float radius, glm::vec3 place = crater_place) {
  const Shape shape = crater(place, radius);
  return codes_of(shape, band_box(shape));
}

TEST(crater, lies_within_its_ball_and_takes_out_most_of_it) {
  for (const float radius : {2.0F, 3.5F, 6.0F, 10.0F, 14.0F, 26.0F}) {
    const Window rough = crater_of(radius);
    const Window ball = codes_of(sphere(crater_place, radius), rough.box);
    for (size_t i = 0; i < ball.codes.size(); ++i)
      ASSERT_TRUE(ball.codes[i] < 0 || rough.codes[i] >= 0) << radius;
    const double share = static_cast<double>(mass_of(rough)) / static_cast<double>(mass_of(ball));
    EXPECT_GT(share, radius < 5.0F ? 0.2 : 0.5) << radius;
    EXPECT_LT(share, 0.95) << radius;
  }
}

/// The part of its ball that a crater of that radius takes out, over many places.
double mean_share(float radius) {
  double sum = 0.0;
  constexpr int places = 60;
  for (int i = 0; i < places; ++i) {
    const glm::vec3 place(53.5F * static_cast<float>(i), -400.0F, 31.1F * static_cast<float>(i % 9));
    const Window rough = crater_of(radius, place);
    sum += static_cast<double>(mass_of(rough)) /
           static_cast<double>(mass_of(codes_of(sphere(place, radius), rough.box)));
  }
  return sum / places;
}

TEST(crater, takes_out_the_part_of_its_ball_that_the_docs_say) {
  for (const float radius : {6.0F, 8.0F, 16.0F, 32.0F}) EXPECT_NEAR(mean_share(radius), 0.62, 0.02) << radius;
  EXPECT_NEAR(mean_share(5.0F), 0.54, 0.04);
  EXPECT_NEAR(mean_share(4.0F), 0.46, 0.04);
  EXPECT_NEAR(mean_share(2.0F), 0.38, 0.04);
}

TEST(crater, the_smallest_takes_something_out_wherever_it_is) {
  for (int i = 0; i < 200; ++i) {
    const auto at = static_cast<float>(i);
    const Window rough = crater_of(1.5F, {0.37F * at, -1.91F * at, 0.83F * at});
    EXPECT_LT(*std::ranges::min_element(rough.codes), 0) << i;
  }
}

/// As a ray that steps by the field's distances, and a body that is pushed out by them, must be able to.
TEST(crater, distances_grow_by_no_more_than_one_a_voxel) {
  constexpr int step_max = 44;  // 42.3 codes are a voxel; either is rounded
  for (const float radius : {3.0F, 10.0F, 17.0F}) {
    const Window rough = crater_of(radius);
    const auto nz = static_cast<size_t>(rough.box.size().z);
    const size_t nyz = nz * static_cast<size_t>(rough.box.size().y);
    int steepest = 0;
    for_each_inner(rough, [&](VoxelCoord, size_t i) {
      for (const size_t step : {size_t{1}, nz, nyz})
        steepest = std::max(steepest, std::abs(rough.codes[i] - rough.codes[i + step]));
    });
    EXPECT_LE(steepest, step_max) << radius;
    EXPECT_EQ(*std::ranges::max_element(rough.codes), code_air);
    EXPECT_TRUE(radius < 9.0F || *std::ranges::min_element(rough.codes) == code_solid) << radius;
  }
}

/// How far a wall's normals turn away from the ball's, degrees; and how far from one sample to the next, half
/// a voxel along the wall.
struct WallTurns {
  double from_ball = 0.0;
  double share_flat =
      0.0;  ///< of samples whose normal is their neighbour's, two voxels away, within 4 degrees
  double share_deep = 0.0;  ///< of samples more than half a voxel within the ball
};

WallTurns turns_of(const Window& window, float radius) {
  constexpr double degrees = 57.29578;
  WallTurns turns;
  int samples = 0;
  const auto between = [](glm::vec3 a, glm::vec3 b) {
    const float cosine = glm::dot(a, b) / std::sqrt(glm::dot(a, a) * glm::dot(b, b));
    return degrees * std::acos(std::clamp(static_cast<double>(cosine), -1.0, 1.0));
  };
  for_each_inner(window, [&](VoxelCoord voxel, size_t i) {
    if (std::abs(window.codes[i]) > 10) return;
    const glm::vec3 at = as_vector(voxel);
    if (!covers(window, at)) return;
    const FieldSample here = sample_covered(window, at + 0.01F);
    if (glm::dot(here.gradient, here.gradient) < 0.25F) return;
    const glm::vec3 out = at - crater_place;
    const glm::vec3 aside = glm::cross(here.gradient, glm::vec3(0.36F, 0.48F, 0.8F));
    if (!covers(window, at + 0.01F + 2.0F * glm::normalize(aside))) return;
    const FieldSample there = sample_covered(window, at + 0.01F + 2.0F * glm::normalize(aside));
    ++samples;
    turns.from_ball += between(here.gradient, out);
    turns.share_flat += between(here.gradient, there.gradient) < 4.0 ? 1.0 : 0.0;
    turns.share_deep += std::sqrt(glm::dot(out, out)) < radius - 0.5F ? 1.0 : 0.0;
  });
  EXPECT_GT(samples, 100);
  turns.from_ball /= samples;
  turns.share_flat /= samples;
  turns.share_deep /= samples;
  return turns;
}

TEST(crater, its_wall_has_faces_and_is_no_ball) {
  constexpr float radius = 14.0F;
  const Window rough = crater_of(radius);
  const WallTurns wall = turns_of(rough, radius);
  const WallTurns ball = turns_of(codes_of(sphere(crater_place, radius), rough.box), radius);
  EXPECT_LT(ball.from_ball, 3.0);
  EXPECT_EQ(ball.share_deep, 0.0);
  EXPECT_GT(wall.from_ball, 15.0);
  EXPECT_GT(wall.share_deep, 0.5);
  EXPECT_GT(wall.share_flat, ball.share_flat + 0.05);
}

TEST(crater, codes_do_not_depend_on_the_box_that_is_asked_for) {
  const Shape shape = crater(crater_place, 7.0F);
  const Window own = codes_of(shape, band_box(shape));
  const Window more = codes_of(shape, own.box.grown(5));
  EXPECT_EQ(part_of(more, own.box).codes, own.codes);
  EXPECT_EQ(mass_of(more), mass_of(own)) << "beyond is air";
  const VoxelBox part{own.box.lo + VoxelCoord{4, 2, 5}, own.box.hi - VoxelCoord{3, 6, 1}};
  EXPECT_EQ(codes_of(shape, part).codes, part_of(own, part).codes);
  const VoxelBox beyond{own.box.hi, own.box.hi + VoxelCoord{3, 3, 3}};
  EXPECT_EQ(mass_of(codes_of(shape, beyond)), 0);
}

TEST(crater, blocks_lie_in_the_world_and_not_in_the_crater) {
  // A voxel deep in both balls is of a block that both take, or neither.
  constexpr float radius = 24.0F;
  const auto deep = 1.2F * static_cast<float>(crater_block_side(radius));
  const glm::vec3 other_place = crater_place + glm::vec3(4.2F, -3.7F, 2.9F);
  const Window one = crater_of(radius), other = crater_of(radius, other_place);
  const VoxelBox both = common(one.box, other.box);
  size_t differ = 0, compared = 0;
  for_each_inner(part_of(one, both), [&](VoxelCoord v, size_t) {
    const auto depth = [&](glm::vec3 place) { return -distance(sphere(place, radius), as_vector(v)); };
    if (std::min(depth(crater_place), depth(other_place)) < deep) return;
    ++compared;
    differ += (one.at(v.x, v.y, v.z) < 0) != (other.at(v.x, v.y, v.z) < 0) ? 1 : 0;
  });
  EXPECT_GT(compared, 50U);
  EXPECT_EQ(differ, 0U);
}

}  // namespace
}  // namespace scree
