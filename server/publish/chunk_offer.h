// Chunks that one client says it has kept from earlier, and how long its streaming waits for that word. Ticks
// are the publisher's. Not thread-safe.
#pragma once

#include <cstdint>
#include <vector>

#include "proto/messages.h"

namespace scree {

class ChunkOffer {
 public:
  /// An offer is announced: no chunks are sent for so many ticks, unless it comes earlier.
  void await(uint32_t ticks) { ticks_to_wait_ = ticks; }
  /// From now on, for so many ticks; what was offered before is forgotten.
  void accept(OfferMessage offer, uint32_t ticks);
  void forget();

  /// Call once a tick: whether chunks may be sent in it.
  bool ready();
  /// Whether the client offered the chunk with this hash. True once for a chunk: who then asks for it again
  /// does not have it.
  bool answers(ChunkCoord chunk, uint64_t hash);

  size_t chunks() const { return offer_.chunks.size(); }

 private:
  OfferMessage offer_;
  std::vector<bool> answered_;  ///< by index in the offer
  uint32_t ticks_to_wait_ = 0;
  uint32_t ticks_to_live_ = 0;
};

}  // namespace scree
