// Operations that add a shape to the terrain or take one out of it, and what they have in common. Internal to
// this folder.
#pragma once

#include "shared/operation/operation.h"

namespace scree {

/// The terrain without a shape, and what it lost by that. All windows have the same box.
struct CarvedTerrain {
  Window before, after;
  Window solid;  ///< the shape
  RockWindow rock;
  std::vector<uint8_t> lost_at;  ///< by voxel
  MaterialMasses lost;
};
CarvedTerrain carved_terrain(const Shape& shape, const Field& field);

/// Notes what was lost.
void enter_lost(const CarvedTerrain& carved, Applied& applied);

Applied apply_fill(const FillOperation& op, Field& field);
Applied apply_dig(const DigOperation& op, Field& field, PieceTable& pieces);
Applied apply_place(const PlaceOperation& op, Field& field);

}  // namespace scree
