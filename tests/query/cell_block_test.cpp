#include "shared/query/cell_block.h"

#include <gtest/gtest.h>
#include <set>

#include "bench/support/carved_field.h"
#include "shared/base/random.h"
#include "shared/query/field_cells.h"
#include "shared/query/volume_cells.h"
#include "shared/surface/surface_nets.h"
#include "tests/support/mesh_position.h"
#include "tests/support/voxel_cube.h"

namespace scree {
namespace {

using Triangles = std::multiset<SurfaceTriangle>;

/// Which corner is the first is of no account.
SurfaceTriangle turned(SurfaceTriangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

Triangles triangles_of(const SurfaceMesh& mesh) {
  Triangles all;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    SurfaceTriangle triangle;
    for (size_t k = 0; k < 3; ++k) triangle[k] = position_of(mesh, mesh.indices[i + k]);
    all.insert(turned(triangle));
  }
  return all;
}

/// The quads of the edges from the voxels of a box.
Triangles triangles_of(CellSource& cells, const VoxelBox& box) {
  Triangles all;
  for_each_brick(box, [&](BrickCoord coord) {
    const CellBlock* block = cells.block(coord);
    if (block == nullptr) return;
    for (int i = 0; i < brick_voxels; ++i) {
      const VoxelCoord at{i >> 6, (i >> 3) & 7, i & 7};
      if (!box.holds(first_voxel(coord) + at)) continue;
      for (int axis = 0; axis < 3; ++axis)
        if (block->is_crossed(at, axis))
          for (const SurfaceTriangle& t : block->quad(at, axis)) all.insert(turned(t));
    }
  });
  return all;
}

TEST(CellBlock, has_the_polygons_of_surface_nets_in_noise) {
  for (uint64_t random_seed = 1; random_seed <= 20; ++random_seed) {
    Random random(random_seed);
    Window noise({{-5, 3, -11}, {16, 22, 9}});
    const uint32_t rock_in_8 = 1 + static_cast<uint32_t>(random_seed % 7);
    for (Code& code : noise.codes) {
      const int depth = static_cast<int>(random.below(127));
      code = static_cast<Code>(random.below(8) < rock_in_8 ? -depth : depth);
    }
    VolumeCells cells(noise);
    const Triangles all = triangles_of(surface_nets_closed(noise));
    EXPECT_GT(all.size(), 1000U);
    EXPECT_EQ(triangles_of(cells, noise.box.grown(2)), all) << random_seed;
  }
}

TEST(CellBlock, has_the_polygons_of_surface_nets_in_a_carved_field) {
  MapField field({TerrainKind::noise, 3, 0.25F});
  roughen(field, {0.0F, ground_height_m(field.source(), 0.0F, 0.0F), 0.0F}, 8.0F, 80, 5);
  FieldCells cells(field);
  const int middle = static_cast<int>(ground_height_m(field.source(), 0.0F, 0.0F) / 0.25F);
  const VoxelBox owned{{-48, middle - 48, -48}, {48, middle + 48, 48}};
  const Triangles all = triangles_of(surface_nets(gather(field, owned.grown(surface_nets_apron)), owned));
  EXPECT_GT(all.size(), 10000U);
  EXPECT_EQ(triangles_of(cells, owned), all);
}

}  // namespace
}  // namespace scree
