#include "client/render/levels/plane_brick.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "shared/field/voxel_vector.h"
#include "tests/support/edged_shapes.h"

namespace scree {
namespace {

template <typename Distance>
Window brick_window(Distance&& distance) {
  Window window(VoxelBox{{0, 0, 0}, {corner_brick_side, corner_brick_side, corner_brick_side}}.grown(
      plane_brick_reach));
  const VoxelBox& box = window.box;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) window.at(x, y, z) = encode(distance(glm::vec3(x, y, z)));
  return window;
}

int marked(const PlaneBrick& planes) {
  int count = 0;
  for (const FacePlane& plane : planes) {
    const glm::vec3 n(plane.normal[0], plane.normal[1], plane.normal[2]);
    const float length = glm::length(n);
    count += length > 20.0F && length < 110.0F ? 1 : 0;
  }
  return count;
}

TEST(PlaneBrickTest, an_edge_is_marked_along_its_cells) {
  const auto planes =
      planes_of(brick_window([](glm::vec3 p) {
                  return box_distance(p - glm::vec3(-6.3F, -6.3F, 0.0F), glm::vec3(10.0F, 10.0F, 40.0F));
                }),
                {});
  ASSERT_NE(planes, nullptr);
  EXPECT_GE(marked(*planes), 8) << "one cell a layer";
}

TEST(PlaneBrickTest, the_eighths_with_edges_are_known) {
  const auto edge_at = [](float x, float y) {
    return planes_of(brick_window([=](glm::vec3 p) {
                       return box_distance(p - glm::vec3(x - 10.0F, y - 10.0F, 0.0F),
                                           glm::vec3(10.0F, 10.0F, 40.0F));
                     }),
                     {});
  };
  const auto near = edge_at(1.7F, 1.7F), across = edge_at(6.3F, 1.7F);
  ASSERT_TRUE(near != nullptr && across != nullptr);
  EXPECT_EQ(edge_eighths(*near), 0b11U) << "in the near half along x and y, in both along z";
  EXPECT_EQ(edge_eighths(*across), 0b11'0000U);
}

/// There were teeth: each cell of an arch had an edge of its own. A pipe is one, too.
TEST(PlaneBrickTest, round_rock_of_small_radius_has_no_edges) {
  const Window pipe =
      brick_window([](glm::vec3 p) { return glm::length(glm::vec2(p.x - 4.2F, p.y + 2.3F)) - 6.5F; });
  EXPECT_EQ(planes_of(pipe, {}), nullptr);
  const Window ball =
      brick_window([](glm::vec3 p) { return glm::length(p - glm::vec3(4.2F, -3.7F, 4.4F)) - 7.0F; });
  EXPECT_EQ(planes_of(ball, {}), nullptr);
}

/// The head of a lamp, a voxel wider than its post.
TEST(PlaneBrickTest, a_step_of_a_voxel_has_both_its_edges) {
  const Window lamp = brick_window([](glm::vec3 p) {
    const float head = box_distance(p - glm::vec3(3.5F, 6.0F, 3.5F), {2.0F, 1.5F, 2.0F});
    const float post = box_distance(p - glm::vec3(3.5F, -10.0F, 3.5F), {1.0F, 14.5F, 1.0F});
    return std::min(head, post);
  });
  const auto planes = planes_of(lamp, {});
  ASSERT_NE(planes, nullptr);
  const auto is_marked = [&](VoxelCoord at) {
    const FacePlane& plane =
        (*planes)[static_cast<size_t>((at.x * corner_brick_side + at.y) * corner_brick_side + at.z)];
    const float length = glm::length(glm::vec3(plane.normal[0], plane.normal[1], plane.normal[2]));
    return length > 20.0F && length < 110.0F;
  };
  EXPECT_TRUE(is_marked({5, 4, 3})) << "the head's lower edge";
  EXPECT_TRUE(is_marked({4, 4, 3})) << "where the post meets it";
}

}  // namespace
}  // namespace scree
