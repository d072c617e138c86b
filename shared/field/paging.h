// Edited chunks that a field does not hold in memory, and where their bricks come from.
//
// A chunk that is out leaves its hash, its mass, and which of its bricks are edited. A read or write of one
// of its bricks brings it in. So paging changes no result, only the place of codes in between.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

#include "shared/base/result.h"
#include "shared/field/brick_patch.h"
#include "shared/field/mass.h"
#include "shared/field/terrain.h"

namespace scree {

/// Reads the edited bricks of a chunk that is out.
using ReadChunk = std::function<Result<std::vector<BrickPatch>>(ChunkCoord)>;

/// What is left of a chunk that is out.
struct PagedChunk {
  uint64_t hash = 0;    ///< Σ brick_hash of the edited bricks
  uint64_t bricks = 0;  ///< bit i: brick i of the chunk is edited; not 0
  MassUnits mass = 0;   ///< of the edited bricks
};

/// What these bricks leave when they are the edited ones of a chunk; an error when they cannot be.
Result<PagedChunk> paged_of(const TerrainSource& source, ChunkCoord chunk,
                            std::span<const BrickPatch> bricks);

/// A chunk that is out is needed at once, and cannot be read: no result without it would be right, so what
/// needs it ends. The message names the file.
class ChunkUnreadable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace scree
