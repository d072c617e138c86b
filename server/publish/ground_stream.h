// Answers requests for unedited ground: generates and encodes each chunk once, and shares the bytes among
// clients. What waits is bounded (limits::ground_chunks_max a session), and so are the work and the bytes of
// a tick; sessions take turns, one chunk each. No sockets and no clock. Not thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <unordered_map>

#include "server/publish/client_view.h"
#include "server/publish/shared_bytes.h"

namespace scree {

class GroundStream {
 public:
  explicit GroundStream(const TerrainSource& source) : source_(source) {}

  /// Queues the chunks. False, and nothing is queued, when more than limits::ground_chunks_max would wait.
  [[nodiscard]] bool ask(uint64_t session, std::span<const ChunkCoord> chunks);
  void leave(uint64_t session) { queues_.erase(session); }
  size_t waiting(uint64_t session) const;

  /// Answers as much as a tick may: calls send(session, bytes) in the order in which each session asked,
  /// until it returns false: then that session gets no more in this tick. `reader(session)`: its view, or
  /// null when it gets nothing at all.
  void serve(const std::function<const ClientView*(uint64_t)>& reader,
             const std::function<bool(uint64_t, const SharedBytes&)>& send);

 private:
  struct Queue {
    std::deque<ChunkCoord> chunks;
    int64_t credit_bytes = 0;
  };
  /// The answer to the first chunk in the queue; null when the tick has no work left for it.
  SharedBytes answer(ChunkCoord chunk, const ClientView& view, int& work_left);
  SharedBytes generated(ChunkCoord chunk, int& work_left);

  TerrainSource source_;
  std::map<uint64_t, Queue> queues_;
  uint64_t served_last_ = 0;  ///< the session whose chunk was generated last: others come first
  std::unordered_map<ChunkCoord, SharedBytes, CoordHash> encoded_;
  size_t encoded_bytes_ = 0;
};

}  // namespace scree
