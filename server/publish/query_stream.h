// Answers questions about space (proto/query.proto) from the published state. What waits is bounded
// (limits::queries_waiting_max a session), and so are the work and the bytes of a tick. Parties take turns at
// the work, and the sessions of a party share its turns (SessionTurns). A message is answered when all of its
// questions are, by one tick: by the newest when its first one's turn comes, or by the one that it asks for.
// If so much ground is generated for it that the tick is gone meanwhile, it begins anew.
// No sockets and no clock. Not thread-safe.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "server/command/refusal.h"
#include "server/publish/client_view.h"
#include "server/publish/outgoing.h"
#include "server/publish/query_scenes.h"
#include "server/publish/session_turns.h"
#include "server/publish/shared_bytes.h"

namespace scree {

class QueryStream {
 public:
  /// The state outlives it.
  QueryStream(const TerrainSource& source, uint32_t tick_rate_hz, const PublishedState& state);

  /// As of QueryScenes: call at each tick.
  void restart() { scenes_.restart(); }
  void before(const TickDelta& delta) { scenes_.before(delta); }
  void after(const TickDelta& delta) { scenes_.after(delta); }

  /// Queues the questions. Refuses all of them when more than limits::queries_waiting_max would wait, or when
  /// the tick that they ask for is too old, or yet to come.
  tl::expected<void, Refused> ask(uint64_t session, uint64_t party, const QueryMessage& query);
  void leave(uint64_t session);
  size_t waiting(uint64_t session) const;

  /// Answers as much as a tick may: calls send(session, bytes) in the order in which each session asked,
  /// until it returns false: then that session gets no more in this tick. `reader(session)`: its view, or
  /// null when it gets nothing at all. Returns chunks that are wanted in memory.
  std::vector<WantedChunk> serve(const std::function<const ClientView*(uint64_t)>& reader,
                                 const std::function<bool(uint64_t, const SharedBytes&)>& send);

  /// Edited chunks that must stay in memory for questions which wait for more of them.
  std::vector<ChunkCoord> needed() const;
  /// Questions that were refused since the last call, each by itself.
  std::vector<Refusal> take_refusals() { return std::exchange(refusals_, {}); }

 private:
  struct Waiting {
    QueryMessage query;
    AnswerMessage answer;
    Tick since = 0;
    float progress = 0.0F;         ///< of the first question that has no answer
    std::set<ChunkCoord> needs{};  ///< chunks that it missed
    int begun_anew = 0;            ///< times that its tick was gone before all had an answer
  };
  struct Queue {
    uint64_t party = 0;
    std::deque<Waiting> messages;
    size_t questions = 0;
    int64_t credit_bytes = 0;
    const ClientView* view = nullptr;  ///< within serve(); null: it gets nothing
  };
  void begin_tick(const std::function<const ClientView*(uint64_t)>& reader);
  /// What is wrong with the question, by itself and for that client.
  tl::expected<void, Refused> check(const Question& question, const ClientView& view) const;
  /// Adds an answer to the message, if it has come so far; what that costs. False: it waits for a chunk.
  bool go_on(Waiting& waiting, const ClientView& view, uint64_t& cost);
  void refuse(Waiting& waiting, const Refused& refused);
  /// Notes what the first message missed, and wants all of it that is out.
  void want_missing(uint64_t session, Queue& queue, std::vector<WantedChunk>& wanted);

  const PublishedState& state_;
  Tick wait_ticks_;
  QueryScenes scenes_;
  std::map<uint64_t, Queue> queues_;
  SessionTurns turns_;
  std::vector<Refusal> refusals_;
};

}  // namespace scree
