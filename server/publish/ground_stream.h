// Answers requests for unedited ground: generates and encodes each chunk once, and shares the bytes among
// clients. What waits is bounded (limits::ground_chunks_max a session), and so are the work and the bytes of
// a tick. Parties take turns at the work, and the sessions of a party share its turns (SessionTurns). No
// sockets and no clock. Not thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <unordered_map>

#include "server/publish/client_view.h"
#include "server/publish/limits.h"
#include "server/publish/session_turns.h"
#include "server/publish/shared_bytes.h"

namespace scree {

class GroundStream {
 public:
  explicit GroundStream(const TerrainSource& source) : source_(source) {}

  /// Queues the chunks. False, and nothing is queued, when more than limits::ground_chunks_max would wait.
  [[nodiscard]] bool ask(uint64_t session, uint64_t party, std::span<const ChunkCoord> chunks);
  void leave(uint64_t session);
  size_t waiting(uint64_t session) const;

  /// How much a tick may generate from now on, as of limits::ground_work_min; positive.
  void set_work(int work_per_tick) { work_per_tick_ = work_per_tick; }

  /// Answers as much as a tick may: calls send(session, bytes) in the order in which each session asked,
  /// until it returns false: then that session gets no more in this tick. `reader(session)`: its view, or
  /// null when it gets nothing at all.
  void serve(const std::function<const ClientView*(uint64_t)>& reader,
             const std::function<bool(uint64_t, const SharedBytes&)>& send);

 private:
  struct Queue {
    std::deque<ChunkCoord> chunks;
    int64_t credit_bytes = 0;
    const ClientView* view = nullptr;  ///< within serve(); null: it gets nothing
  };
  void begin_tick(const std::function<const ClientView*(uint64_t)>& reader);
  /// The answer to the first chunk in the queue; null when the tick has no work left for it.
  SharedBytes answer(ChunkCoord chunk, const ClientView& view, int& work_left);
  SharedBytes generated(ChunkCoord chunk, int& work_left);

  TerrainSource source_;
  int work_per_tick_ = limits::ground_work_min;
  std::map<uint64_t, Queue> queues_;
  SessionTurns turns_;
  std::unordered_map<ChunkCoord, SharedBytes, CoordHash> encoded_;
  size_t encoded_bytes_ = 0;
};

}  // namespace scree
