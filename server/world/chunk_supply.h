// Where the bricks of edited chunks come from that the published state does not hold.
#pragma once

#include <vector>

#include "shared/base/ids.h"
#include "shared/field/brick_patch.h"

namespace scree {

/// What was read of a chunk; it is checked before it is used. Empty when it cannot be read.
struct SuppliedChunk {
  ChunkCoord chunk;
  std::vector<BrickPatch> bricks;
};

/// Reads elsewhere: nobody waits. One thread makes all calls.
class ChunkSupply {
 public:
  virtual ~ChunkSupply() = default;
  /// Edited bricks that the asking side may keep, but for those that are not saved yet.
  virtual size_t bricks_max() = 0;
  /// Chunks whose last change was in this tick, or earlier, can be had.
  virtual Tick saved_tick() = 0;
  /// Whether one more chunk can be asked for: few may be on their way at once.
  virtual bool has_room() = 0;
  /// Asks for a chunk, unless it is on its way or there is no room: then the caller asks again.
  virtual void ask(ChunkCoord chunk) = 0;
  /// Those that came, in order, at most so many at once.
  virtual std::vector<SuppliedChunk> collect(size_t chunks_max) = 0;
};

}  // namespace scree
