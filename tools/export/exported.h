// What is exported: a field, and the chunks of it.
#pragma once

#include "shared/field/field.h"

namespace scree {

/// A half-open box of chunks, not empty.
struct ChunkBox {
  ChunkCoord lo;
  ChunkCoord hi;

  VoxelBox voxels() const { return {first_voxel(lo), first_voxel(hi)}; }
  size_t count() const;
};

/// The chunks that a box in metres touches.
ChunkBox chunks_of(glm::vec3 lo_m, glm::vec3 hi_m, float voxel_size_m);

/// The error says that there are more chunks than one export may have, and what to do.
Result<void> check_count(const ChunkBox& box);

/// Around all that was edited and, where they end, all that the ground has: stored bricks, or else an
/// elevation model, with rock below it. The error says that the ground has no end, and what to do.
Result<ChunkBox> whole_of(const Field& field);

/// What paint and the ground's stored chunks say of a brick's voxels, without the ground's layers.
BrickMaterials said_materials(const Field& field, BrickCoord brick);

}  // namespace scree
