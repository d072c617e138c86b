// The published chunks that are out of memory: they are read when a client wants them, and go when nobody
// does. The reader has room for few; parties take turns at it (SessionTurns). One thread.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <span>

#include "server/publish/encode_cache.h"
#include "server/publish/outgoing.h"
#include "server/publish/session_turns.h"
#include "server/world/chunk_supply.h"
#include "server/world/published_state.h"

namespace scree {

class ChunkPager {
 public:
  /// `supply`: null: all chunks stay in memory.
  explicit ChunkPager(std::shared_ptr<ChunkSupply> supply) : supply_(std::move(supply)) {}

  /// Puts chunks that were read into the state.
  void page_in(PublishedState& state);
  /// Clients want these chunks, which are out: in this tick, and again in the next one.
  void want(std::span<const WantedChunk> chunks);
  /// Asks for the chunks that are wanted, and drops chunks that nobody used lately when there are too many.
  void page(PublishedState& state, EncodeCache& cache);

 private:
  void ask();

  std::shared_ptr<ChunkSupply> supply_;
  std::map<uint64_t, std::deque<ChunkCoord>> wanted_;  ///< by session
  SessionTurns turns_;
};

}  // namespace scree
