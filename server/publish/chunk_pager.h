// The published chunks that are out of memory: they are read when a client wants them, and go when nobody
// does. One thread.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "server/publish/encode_cache.h"
#include "server/world/chunk_supply.h"
#include "server/world/published_state.h"

namespace scree {

class ChunkPager {
 public:
  /// `supply`: null: all chunks stay in memory.
  explicit ChunkPager(std::shared_ptr<ChunkSupply> supply) : supply_(std::move(supply)) {}

  /// Puts chunks that were read into the state.
  void page_in(PublishedState& state);
  /// Clients want these chunks, which are out.
  void want(std::span<const ChunkCoord> chunks);
  /// Asks for the chunks that are wanted, and drops chunks that nobody used lately when there are too many.
  void page(PublishedState& state, EncodeCache& cache);

 private:
  std::shared_ptr<ChunkSupply> supply_;
  std::vector<ChunkCoord> wanted_;
};

}  // namespace scree
