// Which material the voxels of a merge are of. It is decided after the codes, by one rule for every method:
// a voxel takes the merged piece's material where more than half of its mass is new, that of the piece's
// nearest solid voxel. Pure; deterministic.
#pragma once

#include <memory>
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

/// Changes `materials`, those of the terrain before the merge, to those after it, and marks the voxels that
/// changed (a byte each; empty: none). All windows have the same box.
std::vector<uint8_t> merge_materials(MaterialWindow& materials, const Window& before, const Window& after,
                                     std::span<const MergedPiece> pieces, float voxel_size_m);

/// The same for voxels that a solid of one material filled.
std::vector<uint8_t> fill_materials(MaterialWindow& materials, const Window& before, const Window& after,
                                    Material material);

}  // namespace scree
