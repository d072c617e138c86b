#include "client/render/levels/air_distances.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "client/render/levels/level_bricks.h"
#include "shared/field/voxel_vector.h"
#include "shared/operation/operation.h"

namespace scree {
namespace {

TEST(AirDistances, are_at_most_the_way_to_rock_nearby) {
  Window window(VoxelBox{{0, 0, 0}, {9, 9, 9}});
  window.at(4, 4, 4) = -10;
  lower_air(window);
  for (int x = 0; x < 9; ++x)
    for (int y = 0; y < 9; ++y)
      for (int z = 0; z < 9; ++z) {
        const glm::vec3 off = as_vector(VoxelCoord{x, y, z} - VoxelCoord{4, 4, 4});
        const float way = glm::length(off) - 10.0F / 127.0F * 3.0F;
        const float found = decode(window.at(x, y, z));
        if (x == 4 && y == 4 && z == 4) {
          EXPECT_EQ(window.at(x, y, z), -10) << "rock stays as it is";
        } else {
          // A way along the lattice is a little longer than a straight one.
          EXPECT_LE(found, 1.1F * way + 0.05F);
          EXPECT_GE(found, std::min(way - 0.1F, 3.0F));
        }
      }
}

TEST(AirDistances, of_a_coarse_level_do_not_step_through_a_thin_wall) {
  const TerrainSource flat{.kind = TerrainKind::flat, .random_seed = 1, .voxel_size_m = 0.25F};
  MapField field(flat);
  PieceTable table;
  // Two voxels thick, whose distances end in the air that a coarser level generates.
  apply(Operation(FillOperation{box({-13.125F, 3.125F, 0.125F}, {0.25F, 3.0F, 8.0F}), Material{6}}), field,
        table);
  for (const int level : {1, 2}) {
    LevelBricks bricks(flat, level);
    const float voxel_m = 0.25F * static_cast<float>(1 << level);
    const auto side_m = static_cast<float>(brick_size) * voxel_m;
    const BrickCoord at{static_cast<int>(std::floor(-12.9F / side_m)), 0, 0};
    const LevelBrick read = bricks.read(field, at);
    ASSERT_EQ(read.kind, LevelBrick::Kind::stored);
    const auto code = [&](int x) {
      return read.field[static_cast<size_t>(((x + 1) * atlas_brick_side + 4) * atlas_brick_side + 4)];
    };
    for (int x = 0; x < brick_size; ++x)
      for (const auto& [here, beside] : {std::pair(x, x + 1), std::pair(x + 1, x)})
        EXPECT_LE(code(here), std::max<int>(code(beside), 0) + 43) << level << " " << here;
  }
}

}  // namespace
}  // namespace scree
