// Ground that is made of smooth functions is drawn without edges, until somebody gives it some.
#include <gtest/gtest.h>

#include "client/render/levels/block_windows.h"
#include "shared/operation/operation.h"
#include "shared/surface/creases.h"

namespace scree {
namespace {

constexpr int block = 32;

bool same_vertices(const SurfaceMesh& a, const SurfaceMesh& b) {
  if (a.vertices.size() != b.vertices.size()) return false;
  for (size_t i = 0; i < a.vertices.size(); ++i)
    for (size_t axis = 0; axis < 3; ++axis) {
      const std::array<int, 3> from_a{a.origin.x, a.origin.y, a.origin.z},
          from_b{b.origin.x, b.origin.y, b.origin.z};
      if (from_a[axis] * surface_steps + a.vertices[i].position[axis] !=
          from_b[axis] * surface_steps + b.vertices[i].position[axis])
        return false;
    }
  return true;
}

/// The blocks of the canyon about the foot of its cliff.
template <typename F>
void for_each_block(const Field& field, F&& f) {
  for (int x = -2; x < 3; ++x)
    for (int y = -1; y < 3; ++y)
      for (int z = -2; z < 3; ++z) {
        const VoxelCoord lo{x * block, y * block, z * block};
        const auto windows = gather_windows(field, {lo, lo + VoxelCoord{block, block, block}});
        if (windows) f(*windows);
      }
}

TEST(SmoothGround, has_no_edges_though_some_of_it_looks_like_one) {
  const MapField field({TerrainKind::canyon, 1, 0.25F});
  size_t blocks = 0, like_edges = 0;
  for_each_block(field, [&](const BlockWindows& windows) {
    ++blocks;
    const SurfaceMesh smooth = windows.mesh(FaceEdges::rounded);
    EXPECT_TRUE(same_vertices(windows.mesh(FaceEdges::sharp), smooth));
    SurfaceMesh creased = smooth;
    sharpen_creases(windows.now, creased);
    like_edges += same_vertices(creased, smooth) ? 0 : 1;
  });
  EXPECT_GT(blocks, 10U);
  EXPECT_GT(like_edges, 0U) << "else this test says nothing";
}

TEST(SmoothGround, gets_the_edges_that_somebody_cuts) {
  MapField field({TerrainKind::canyon, 1, 0.25F});
  PieceTable pieces;
  const float ground_m = ground_height_m(field.source(), 4.0F, 4.0F);
  apply(Operation(FillOperation{box({4.0F, ground_m + 1.0F, 4.0F}, {1.5F, 1.5F, 1.5F}), material::rock}),
        field, pieces);
  size_t sharpened = 0;
  for_each_block(field, [&](const BlockWindows& windows) {
    sharpened += same_vertices(windows.mesh(FaceEdges::sharp), windows.mesh(FaceEdges::rounded)) ? 0 : 1;
  });
  EXPECT_GE(sharpened, 1U);
  EXPECT_LE(sharpened, 8U) << "the blocks that the block of rock touches";
}

}  // namespace
}  // namespace scree
