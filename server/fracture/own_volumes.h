// Volumes of pieces from voxels that somebody made, and that may be anything.
#pragma once

#include <vector>

#include "shared/base/result.h"
#include "shared/field/piece.h"
#include "shared/material/rubble.h"

namespace scree {

/// A volume for each part of the given one whose solid voxels (code < 0) connect by their faces, in the order
/// of their first voxels and in its voxel frame. Codes become distances to the zero level, which stays where
/// linear interpolation between the voxels puts it; no solid voxel is lost. Masses are those of the codes,
/// rubble is its stones, and voxels beside the rock have its material. Parts of one voxel, and those below
/// limits::piece_mass_min, are left out. The error says that nothing is left, or that they are more than
/// limits::cut_rests_max. Pure.
Result<std::vector<Volume>> own_volumes(const Volume& given, const RubbleRows& rubble);

}  // namespace scree
