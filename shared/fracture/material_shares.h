// Which materials the pieces of a cut are of, beside the cutters, which know codes alone.
#pragma once

#include "shared/field/material_window.h"
#include "shared/fracture/cutter.h"

namespace scree {

/// What was lost at each voxel (units, in a window's order), by material: in order, none of it 0.
MaterialMasses masses_lost(const std::vector<uint8_t>& lost, const MaterialWindow& materials);

/// Gives each of the cut's pieces the materials of its voxels, and shares `lost`, the mass that was cut by
/// material, out among pieces and dust: each piece's and the dust's sum stays, and so does each material's.
/// Within that, a piece gets materials in proportion to the mass of its voxels. `materials` are those of all
/// that was cut, in whose box the pieces' windows lie. Returns the dust by material.
MaterialMasses share_materials(Cut& cut, const MaterialWindow& materials, const MaterialMasses& lost);

}  // namespace scree
