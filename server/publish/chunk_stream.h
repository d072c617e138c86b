// Streams to one client the chunks that it lacks, nearest first, within a budget of bytes and the room of its
// link. Chunks that the client has offered are confirmed instead. One thread at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "server/publish/chunk_offer.h"
#include "server/publish/client_view.h"
#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class ChunkStream {
 public:
  ChunkOffer& offer() { return offer_; }
  /// Sends what this tick has room for.
  void serve(const ServedTick& tick, ClientView& view, Outlet& outlet, ServedPart& part);
  /// Chunks that the client follows since the last serve().
  const std::vector<ChunkCoord>& followed() const { return followed_; }

 private:
  SharedBytes whole(const ServedTick& tick, ClientView& view, ChunkCoord coord,
                    const PublishedChunk& chunk) const;
  SharedBytes next_part(const ServedTick& tick, ClientView& view, const Outlet& outlet, ChunkCoord coord,
                        const PublishedChunk& chunk);
  void send_unchanged(const UnchangedChunksMessage& unchanged, Outlet& outlet, ServedPart& part);

  int64_t credit_bytes_ = 0;
  int next_brick_ = 0;  ///< of a chunk, where the next part begins
  ChunkOffer offer_;
  std::vector<ChunkCoord> followed_;
};

}  // namespace scree
