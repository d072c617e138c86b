// Which material the voxels of a merge or a fill are of, by one rule for every method; of a merged piece,
// that of the piece's nearest solid voxel, or the rubble of that. Where all is solid, it is decided after the
// codes: a voxel takes the new material where enough of its mass is new. Enough is a share between a quarter
// and three quarters: that by which the merge converts least in sum. Where something has pores, a voxel's
// mass depends on its material, so it is decided before the codes: a changed voxel takes the new material
// where it was not solid (MergeFills). Pure; deterministic.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/field/material_window.h"
#include "shared/field/piece.h"
#include "shared/recombine/stamp_plan.h"

namespace scree {

/// A piece at the pose at which it merges.
struct MergedPiece {
  const Volume& volume;
  QuantisedPose pose;
};

/// Whether all of the pieces are of that one material.
bool are_all_of(std::span<const MergedPiece> pieces, Material material);

/// What the terrain's voxels are filled with, and what a merge brings them.
MergeFills merge_fills(const MaterialReader& were, const RubbleRows& rows,
                       std::span<const MergedPiece> pieces, Brings brings, float voxel_size_m);

struct AddedMaterials {
  MaterialMasses gains;         ///< of the terrain, by material; of rubble, that of its stones
  std::vector<BrickSays> says;  ///< bricks that say another thing of their voxels now, in order
};

/// The materials of a merge that turned `before` into `after`, both over the reader's box.
AddedMaterials merge_materials(const MaterialReader& were, const RubbleRows& rows, const Window& before,
                               const Window& after, std::span<const MergedPiece> pieces, Brings brings,
                               float voxel_size_m);

/// The same of a fill; of no material: the voxels stay what they were.
AddedMaterials fill_materials(const MaterialReader& were, const RubbleRows& rows, const Window& before,
                              const Window& after, std::optional<Material> material);

}  // namespace scree
