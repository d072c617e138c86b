// Which material the voxels of a merge or a fill are of. It is decided after the codes, by one rule for every
// method: a voxel takes the new material where enough of its mass is new; of a merged piece, that of the
// piece's nearest solid voxel. Enough is a share between a quarter and three quarters: that by which the
// merge converts least in sum. Pure; deterministic.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/field/material_window.h"
#include "shared/field/piece.h"

namespace scree {

/// A piece at the pose at which it merges.
struct MergedPiece {
  const Volume& volume;
  QuantisedPose pose;
};

/// Whether all of the pieces are of that one material.
bool are_all_of(std::span<const MergedPiece> pieces, Material material);

struct AddedMaterials {
  MaterialMasses gains;         ///< of the terrain, by material
  std::vector<BrickSays> says;  ///< bricks that say another thing of their voxels now, in order
};

/// The materials of a merge that turned `before` into `after`, both over the reader's box. `bring`: the
/// voxels take the pieces' materials; else they stay what they were.
AddedMaterials merge_materials(const MaterialReader& were, const Window& before, const Window& after,
                               std::span<const MergedPiece> pieces, bool bring, float voxel_size_m);

/// The same of a fill; of no material: the voxels stay what they were.
AddedMaterials fill_materials(const MaterialReader& were, const Window& before, const Window& after,
                              std::optional<Material> material);

}  // namespace scree
