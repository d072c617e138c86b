// What operations cost by the model of work: microseconds on one core of the machine that
// shared/operation/limits.h names. Prices are functions of the operation and of what it is applied to alone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shared/field/field.h"
#include "shared/field/window.h"
#include "shared/fracture/cutter.h"
#include "shared/operation/operation.h"

namespace scree {

/// Voxels of a box.
float voxels_of(const VoxelBox& box);

/// Chunks of the box that no edit has touched: their terrain may have to be generated. Whether it has been is
/// not part of the simulation's state.
size_t untouched_chunks(const VoxelBox& box, const Field& field);

/// Reading and changing the field in the box of a shape that is valid.
float edit_price_us(const Shape& shape, const Field& field);
/// Cutting a volume whose window has so many voxels into so many pieces, with their hulls and bodies.
float cut_price_us(Cutter cutter, float voxels, uint32_t pieces);
/// Merging a piece whose window has so many voxels.
float merge_price_us(StampMethod method, float voxels);
/// Lifting an island of that box, with its hulls and body.
float lift_price_us(const VoxelBox& box);

/// Finding what a cut leaves of a piece whose window has so many voxels.
float rest_price_us(float voxels);
/// Making so many bricks what they were once.
float restore_price_us(size_t bricks);
/// Letting rubble slide in that box.
float slide_price_us(const VoxelBox& box);

/// Applying a valid operation to this field and these pieces.
float price_us(const Operation& operation, const Field& field, const PieceTable& pieces);

}  // namespace scree
