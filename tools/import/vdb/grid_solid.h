// A solid of an OpenVDB grid, read through its transform. Internal to import/vdb.
#pragma once

#include "tools/import/placement.h"
#include "tools/import/solid.h"
#include "tools/import/vdb/vdb_grids.h"

namespace scree {

/// Rock is where sign · (value − iso) is negative; of a level set 1 and 0, of a fog volume −1 and the
/// density.
struct GridSide {
  float iso = 0.0F;
  float sign = 1.0F;
};

/// Rows of materials by voxel. What a number of the grid stands for; numbers beyond the list say nothing.
struct MaterialGrid {
  openvdb::Int32Grid::Ptr grid;  ///< null: none says anything
  std::vector<VoxelMaterial> rows{};
};

/// The grid's values are finite, and a level set's are metres. The error
/// says that it is beyond the world, or too large for voxels of that size.
Result<std::unique_ptr<Solid>> solid_of_grid(openvdb::FloatGrid::Ptr grid, MaterialGrid materials,
                                             const GridSide& side, const Placement& place,
                                             float voxel_size_m);

/// The volume of the grid's own voxels that are rock, cubic metres in the world. Voxels at the surface of a
/// level set count in part.
double rock_volume_m3(const openvdb::FloatGrid& grid, const GridSide& side, const Placement& place);

}  // namespace scree
