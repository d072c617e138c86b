// What a world's terrain takes in memory, by a model of the simulation's state alone: edited bricks in the
// field, in the published state and in a recording, the regions of OpenVDB's tree that hold them, and
// generated chunks. So every server of the same requests refuses the same ones. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>

#include "shared/field/field.h"

namespace scree {

class TerrainMemory {
 public:
  /// These bricks were edited.
  void note(std::span<const BrickCoord> bricks);

  /// Bytes in use with so many edited bricks, and all that generated chunks may take.
  double used_bytes(size_t edited_bricks, uint32_t max_mb) const;
  /// A bound of added_bytes() that costs nothing.
  static double most_added_bytes(const VoxelBox& box);
  /// The most bytes that an edit of that box may add.
  double added_bytes(const VoxelBox& box, const Field& field) const;

 private:
  std::set<BrickCoord> regions_;  ///< those with edited bricks, in regions
};

/// Generated chunks that a field may keep when all memory is so many megabytes.
size_t generated_chunks_within(uint32_t max_mb);

}  // namespace scree
