// What voxels say comes back as it was packed, by each number of values.
#include "shared/field/brick_materials.h"

#include <gtest/gtest.h>

#include "shared/base/random.h"

namespace scree {
namespace {

TEST(BrickMaterials, of_any_number_of_values_come_back) {
  Random random(3);
  for (uint32_t values = 1; values <= 255; values += values < 20 ? 1 : 47)
    for (int round = 0; round < 8; ++round) {
      VoxelMaterials voxels;
      for (VoxelMaterial& voxel : voxels)
        voxel = static_cast<VoxelMaterial>(random.below(values) * (round % 2 == 0 ? 1 : 255 / values));
      const BrickMaterials packed(voxels);
      EXPECT_EQ(packed.unpacked(), voxels) << values;
      for (int i = 0; i < brick_voxels; ++i)
        ASSERT_EQ(packed.at(i), voxels[static_cast<size_t>(i)]) << values << ", " << i;
    }
}

}  // namespace
}  // namespace scree
