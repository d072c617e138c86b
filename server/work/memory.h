// A model of the server's memory. It counts edited bricks in the field and in the published state, the
// regions of OpenVDB's tree that hold them, the remains of chunks that are out, generated chunks, and a part
// that does not depend on the terrain (limits::fixed_memory_bytes). Which chunks are in memory depends on the
// disk's speed, so the simulation never asks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "shared/field/field.h"

namespace scree {

/// Bytes of a megabyte of memory: 2^20.
inline constexpr double bytes_per_mb = 1024.0 * 1024.0;

/// Figures of a field that pages.
struct TerrainMemory {
  size_t bricks = 0;          ///< edited ones, in memory
  size_t regions = 0;         ///< of OpenVDB's tree with some of them
  size_t chunks_out = 0;      ///< edited chunks that are not in memory
  double beyond_bytes = 0.0;  ///< that the process has in RAM and the model does not know of

  bool operator==(const TerrainMemory&) const = default;
};
TerrainMemory memory_of(const Field& field);

/// Bytes in use, and all that generated chunks may take when all memory is so many megabytes.
double used_bytes(const TerrainMemory& memory, uint32_t max_mb);
/// The most bytes that an edit of that box may add.
double added_bytes(const VoxelBox& box, const Field& field);
/// Edited bricks in memory above which chunks that nobody needs go out.
size_t bricks_within(uint32_t max_mb, const TerrainMemory& memory);

/// Bytes of generated chunks that a field may keep when all memory is so many megabytes.
size_t generated_bytes_within(uint32_t max_mb);

}  // namespace scree
