// Answers requests for tiles of the ground. What waits is bounded (limits::tiles_wanted_max a session), and
// so are the bytes of a tick, of each session and of all. Parties take turns, and the sessions of a party
// share its turns (SessionTurns). No sockets and no clock. Not thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>

#include "proto/messages.h"
#include "server/publish/client_view.h"
#include "server/publish/session_turns.h"
#include "server/publish/shared_bytes.h"

namespace scree {

class TileStream {
 public:
  /// `heights` may be null: then the ground has no tiles, and requests are skipped.
  explicit TileStream(std::shared_ptr<const GroundModel> heights) : heights_(std::move(heights)) {}

  /// Notes what the client holds in `view`, and queues what it wants. False, and nothing is queued, when more
  /// than limits::tiles_wanted_max would wait.
  [[nodiscard]] bool ask(uint64_t session, uint64_t party, const AskTilesMessage& request, ClientView& view);
  void leave(uint64_t session);
  size_t waiting(uint64_t session) const;

  /// Answers as much as a tick may: calls send(session, bytes), and notes in the session's view that it has
  /// the tile. `reader(session)`: its view, or null when it gets nothing in this tick. send() is false when
  /// that is the last one of this tick for the session.
  void serve(const std::function<ClientView*(uint64_t)>& reader,
             const std::function<bool(uint64_t, const SharedBytes&)>& send);

 private:
  struct Queue {
    std::deque<TileKey> tiles;
    int64_t credit_bytes = 0;
    ClientView* view = nullptr;  ///< within serve(); null: it gets nothing
  };
  /// The next tile that the client does not have; it has it from now on. Null: there is none.
  SharedBytes next_tile(Queue& queue) const;

  std::shared_ptr<const GroundModel> heights_;
  std::map<uint64_t, Queue> queues_;
  SessionTurns turns_;
};

}  // namespace scree
