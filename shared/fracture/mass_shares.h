// Sharing the mass of a volume out among its parts. Deterministic; voxels.
#pragma once

#include <cstdint>
#include <vector>

#include "shared/field/mass.h"
#include "shared/fracture/cell_cut.h"
#include "shared/fracture/cell_groups.h"

namespace scree {

/// Mass, and first moments of it about the low corner of the window shared out.
struct PartMass {
  MassUnits mass = 0;
  MassUnits x = 0;
  MassUnits y = 0;
  MassUnits z = 0;
};

/// The part nearest to each voxel: that of the voxel's cell.
struct NearestParts {
  const std::vector<CellLabel>& cells;  ///< of each voxel
  const std::vector<CellLabel>& parts;  ///< of each cell: an index of parts
};

/// Shares the mass of each voxel in `lost` (units) out among the parts, by the shares of the voxel within
/// their planes. Mass that no part claims goes to the nearest part. The sum is exactly that of `lost`. `lost`
/// and `nearest.cells` have a value for each voxel of `box`, which holds all the parts' windows; every voxel,
/// also one without mass, has a cell that there is, and every cell a part.
std::vector<PartMass> share_out(const VoxelBox& box, const std::vector<uint8_t>& lost,
                                const NearestParts& nearest, const std::vector<CellPart>& parts);

}  // namespace scree
