// A part of a chunk, for a link that would take too long for the whole one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "proto/messages.h"
#include "server/world/published_state.h"

namespace scree {

struct ChosenBricks {
  uint64_t bricks = 0;  ///< bit i for brick i
  int next = 0;         ///< where to go on the next time
};

/// Takes as many of the bricks `lacking` as a part of about so many bytes on the wire has
/// (limits::patch_brick_bytes each), one at least. It takes them in turn from brick `first` (0 to 63) on, so
/// that bricks that change again and again do not keep others back.
ChosenBricks choose_bricks(uint64_t lacking, int first, size_t bytes);

/// Those of the chunk's bricks, as a part of it; `more`: the client still lacks others.
ChunkMessage part_of_chunk(ChunkCoord coord, const PublishedChunk& chunk, uint64_t bricks, bool more);

}  // namespace scree
