// What vertices say of their looks: how worn the ground is, its layers, its paint.
#include <gtest/gtest.h>

#include "client/render/levels/block_windows.h"
#include "shared/field/edit.h"
#include "shared/field/paint.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

/// A pit with walls along x = ±2 m in flat ground, whose uppermost metre is soil.
class Looks : public testing::Test {
 protected:
  void SetUp() override {
    PieceTable table;
    const CarveOperation pit{box({0.0F, 0.0F, 0.0F}, {2.0F, 3.0F, 6.0F}), {}, 1, 5, {}, 1};
    apply(Operation(pit), field_, table);
  }
  /// Calls f(vertex, place in voxels) for each vertex of a block about one of the pit's edges.
  template <typename F>
  void for_each_vertex(F&& f) {
    const std::optional<BlockWindows> windows = gather_windows(field_, {{0, -16, 0}, {16, 16, 16}});
    ASSERT_TRUE(windows);
    const SurfaceMesh mesh = windows->mesh();
    ASSERT_FALSE(mesh.empty());
    for (const SurfaceVertex& vertex : mesh.vertices)
      f(vertex,
        glm::vec3(mesh.origin.x, mesh.origin.y, mesh.origin.z) +
            glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / surface_steps_per_voxel);
  }
  static float layer_m(const SurfaceVertex& vertex) {
    return static_cast<float>(vertex.paint / paint_in_cuts) * layer_step_m;
  }

  MapField field_{flat_terrain};
};

TEST_F(Looks, a_wall_is_worn_up_to_the_ground_that_it_ends_at) {
  size_t walls = 0, ground = 0;
  for_each_vertex([&](const SurfaceVertex& vertex, glm::vec3 p) {
    const bool upright = std::abs(vertex.normal[0]) > 120;
    const bool flat = vertex.normal[1] > 126 && p.x > 12.5F;
    // Two voxels below the ground's surface, at most.
    if (upright && p.y > -2.0F) {
      ++walls;
      EXPECT_GT(vertex.before, 28) << p.x << " " << p.y;
    }
    if (flat && p.y > -1.0F) {
      ++ground;
      EXPECT_LE(vertex.before, 4) << p.x << " " << p.y;
    }
  });
  EXPECT_GT(walls, 10U);
  EXPECT_GT(ground, 10U);
}

TEST_F(Looks, a_layer_becomes_thinner_with_depth_and_ends_as_deep_as_it_is) {
  const float depth_m = traits_of(material::soil).layer_depth_m;
  size_t walls = 0;
  for_each_vertex([&](const SurfaceVertex& vertex, glm::vec3 p) {
    if (std::abs(vertex.normal[0]) < 120 || vertex.before < 58) return;
    ++walls;
    const float within_m = std::clamp(depth_m + p.y * voxel_m, 0.0F, layer_step_m * layer_steps_max);
    EXPECT_NEAR(layer_m(vertex), within_m, 0.06F) << p.y;
  });
  EXPECT_GT(walls, 50U);
}

TEST_F(Looks, paint_lies_beside_the_layer) {
  paint(field_, in_voxels(box({2.0F, -2.0F, 2.0F}, {2.0F, 2.0F, 2.0F}), voxel_m), material::ice);
  size_t layered = 0;
  for_each_vertex([&](const SurfaceVertex& vertex, glm::vec3 p) {
    if (std::abs(vertex.normal[0]) < 120 || vertex.before < 58 || p.z < 1.0F || p.z > 15.0F) return;
    EXPECT_EQ(vertex.paint % paint_in_cuts, paint_number(material::ice)) << p.y;
    layered += layer_m(vertex) > 0.2F;
  });
  EXPECT_GT(layered, 10U);
}

TEST(VertexPaint, tells_a_piece_that_is_of_one_material_from_one_that_is_of_a_layer) {
  EXPECT_EQ(vertex_paint(paint_number(material::ice)), paint_number(material::ice));
  EXPECT_EQ(vertex_paint(layer_number(material::soil)), paint_in_cuts * layer_steps_max);
  EXPECT_EQ(vertex_paint(layer_number(material::rock)), 0);
  EXPECT_EQ(vertex_paint(3, -1.0F), 3);
}

}  // namespace
}  // namespace scree
