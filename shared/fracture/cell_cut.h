// Cutting a volume along the planes half-way between seeds, and sharing its mass out among the parts.
// Deterministic; voxels.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/mass.h"
#include "shared/field/window.h"

namespace scree {

/// A part of a volume, and the share of each voxel of its window that lies within its planes: 0 … 254.
struct CellPart {
  Window window;
  std::vector<uint8_t> within;
};

/// The part of the volume within `box` that is nearer to one of the own seeds than to any neighbour's. The
/// box lies in the volume's; there is at least one own seed; no two seeds coincide.
CellPart cut_part(const Window& volume, const VoxelBox& box, const std::vector<glm::vec3>& own,
                  const std::vector<glm::vec3>& neighbours);

/// Mass, and first moments of it about the low corner of the window shared out.
struct PartMass {
  MassUnits mass = 0;
  MassUnits x = 0;
  MassUnits y = 0;
  MassUnits z = 0;
};

/// Shares the mass of each voxel in `lost` (units) out among the parts, by the shares of the voxel within
/// their planes. Mass that no part claims goes to the part in `nearest` (an index a voxel). The sum is
/// exactly that of `lost`. `lost` and `nearest` have a value for each voxel of `box`, which holds all the
/// parts' windows.
std::vector<PartMass> share_out(const VoxelBox& box, const std::vector<uint8_t>& lost,
                                const std::vector<uint16_t>& nearest, const std::vector<CellPart>& parts);

}  // namespace scree
