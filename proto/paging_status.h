// What a server tells of chunks that are out of memory.
#pragma once

#include <cstdint>

namespace scree {

/// Which edited chunks are in memory.
struct PagingStatus {
  uint32_t chunks_in = 0;
  uint32_t chunks_out = 0;     ///< in the world's file alone
  uint32_t chunks_read = 0;    ///< in the last second
  uint64_t chunk_waits = 0;    ///< times that a tick waited for a chunk, since the start
  uint64_t requests_held = 0;  ///< that waited for theirs, since the start

  bool operator==(const PagingStatus&) const = default;
};

}  // namespace scree
