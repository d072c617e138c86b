// Turns the ticks of the world into messages for each client. ClientView selects; clients with the same
// selection share the encoded bytes; slow readers get less.
//
// It composes: PublishedState and Motions (what clients have in common), a ClientFeed for each client,
// EncodeCache, GroundStream, TileStream, ContentStream and QueryStream, ChunkPager (chunks out of memory) and
// StatusBoard; publish() and stream() are their order. Work that many clients can ask for, each as much as it
// likes, is done in the parties' turns (SessionTurns): ground, tiles, content, questions, chunks out of
// memory, and scans of interests that moved.
//
// A client gets a frame of a tick in which something happened for it, and one every limits::heartbeat_s
// anyway, by which it sees that time goes on. The frame of its tick comes
// before a status.
//
// A slow client gets newer state, not a longer queue. Chunks come to it in parts (chunk_part.h). While more
// waits for it than its link takes soon (Backlog), it gets no poses and no streaming; above
// outbox_resync_bytes, no frames either. When it has read everything, a ResetMessage tells it to forget its
// edits and pieces, and it joins anew.
//
// No sockets and no clock: the owner delivers the bytes in order. One thread, the workers' owner, makes all
// calls. Within publish() the workers serve the clients, each client on one of them: a client's part changes
// nothing but the client, the cache, and the messages and counts of its part, which are put together in the
// clients' order. So each client gets the same bytes however many workers there are.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "proto/messages.h"
#include "server/publish/body_list.h"
#include "server/publish/chunk_pager.h"
#include "server/publish/client_feed.h"
#include "server/publish/content_stream.h"
#include "server/publish/encode_cache.h"
#include "server/publish/ground_stream.h"
#include "server/publish/limits.h"
#include "server/publish/outgoing.h"
#include "server/publish/query_stream.h"
#include "server/publish/session_turns.h"
#include "server/publish/status_board.h"
#include "server/publish/tile_stream.h"
#include "server/world/chunk_supply.h"
#include "shared/base/workers.h"

namespace scree {

struct PublisherConfig {
  TerrainSource terrain;
  uint32_t tick_rate_hz = 60;
  uint32_t ticks_per_transform = 3;
  double heartbeat_s = limits::heartbeat_s;     ///< 0: a frame every tick
  std::shared_ptr<ChunkSupply> chunks = {};     ///< null: all chunks stay in memory
  std::shared_ptr<const Palette> palette = {};  ///< as of ContentStream, as the next one
  std::shared_ptr<const ContentFiles> images = {};
  std::shared_ptr<const ContentFiles> models = {};
};

class Publisher {
 public:
  /// `workers` outlives the publisher.
  Publisher(const PublisherConfig& config, Workers& workers);

  /// `operations`: as of ClientView; where there are any, the client gets motions, else whole poses
  /// (Frame.motions, Frame.transforms). `offers`: an offer follows, and chunks wait for it. `party`: as of
  /// Command; 0: the session shares its turns with no other.
  void join(uint64_t session, glm::vec3 eye_m, float radius_m, size_t operations, bool offers = false,
            uint64_t party = 0);
  void leave(uint64_t session);
  void set_interest(uint64_t session, glm::vec3 eye_m, float radius_m);
  /// Takes the client's word for the chunks that it has; of this world.
  void offer(uint64_t session, const OfferMessage& offer);
  /// Sends those of the request's chunks again whose hash differs from the server's at that tick.
  void repair(uint64_t session, const RepairMessage& request);
  /// Queues chunks whose ground the client asks for; false when too many would wait (GroundStream::ask).
  [[nodiscard]] bool ask_ground(uint64_t session, const AskGroundMessage& request);
  /// Takes what the client has of the ground's tiles, and queues what it asks for (TileStream::ask).
  [[nodiscard]] bool ask_tiles(uint64_t session, const AskTilesMessage& request);

  /// Queues content that the client asks for (ContentStream::ask).
  [[nodiscard]] bool ask_content(uint64_t session, const AskContentMessage& request);
  /// Queues questions about space (QueryStream::ask).
  tl::expected<void, Refused> ask_query(uint64_t session, const QueryMessage& query);
  std::vector<Refusal> take_query_refusals() { return queries_.take_refusals(); }
  /// What is there, as of the tick that was published last.
  AdminListMessage list(const ListBodiesRequest& request) const;
  AdminListMessage list(const ListJointsRequest& request) const;
  AdminListMessage list(const ListStoresRequest& request) const;
  AdminListMessage list(const ListRegionMassesRequest& request) const;
  /// WelcomeMessage::palette.
  const std::optional<Digest>& palette() const { return content_.palette(); }

  /// Sets how much ground a tick generates, as of GroundStream.
  void set_ground_work(int work_per_tick) { ground_.set_work(work_per_tick); }
  /// Sets how often the server has refused requests and sessions, for the status.
  void set_refusals(const RefusalCounts& refusals) { board_.set_refusals(refusals); }
  /// Sets the stages of the last second's requests, for the status.
  void set_latency(const LatencyStatus& latency) { board_.set_latency(latency); }
  /// Sets how the world is saved, for the status.
  void set_saving(Saving saving) { board_.set_saving(std::move(saving)); }
  /// Sets the eye and aim of the session's person, for other clients. `party`: as of Command.
  void set_cursor(PlayerCursor cursor, uint64_t party);
  const std::map<uint64_t, PartyCursor>& cursors() const { return cursors_; }
  /// Why the client may not control a replay, for PlaybackMessage; empty: it may.
  void set_control_refusal(uint64_t session, const std::string& refusal);
  /// What all clients are told alike, of the last second.
  StatusMessage status() const { return board_.status(state_, clients_.size()); }
  /// Whose store is the client's own, for StoresMessage.
  void set_store(uint64_t session, const StoreName& own);
  /// The team that the client's access token states, and whether it wants lines (HelloMessage::meets).
  void set_team(uint64_t session, const std::string& team, bool meets);
  /// Whether the client gets StoneMessages.
  void want_stones(uint64_t session, bool wanted);
  /// Whether the client gets PhysicsMessages of the ticks that have them.
  void subscribe_physics(uint64_t session, bool physics);
  /// Whether the client gets ContactsMessages, as of PhysicsFeed::set_contacts.
  void subscribe_contacts(uint64_t session, float least_j);
  bool has_physics_subscribers() const { return physics_subscribers_ > 0; }
  /// Eyes of all clients, by session, as of the last tick.
  const std::vector<glm::vec3>& eyes_m() const { return eyes_m_; }

  /// Takes the world before the first tick. Called once, before anybody joins.
  void begin(const TickDelta& keyframe);
  /// Takes the next tick and returns the messages for each client. `backlog(session)`: what still waits for
  /// it; called by the workers, too. A tick out of sequence is a keyframe: it replaces the state, and resets
  /// every client.
  std::vector<Outgoing> publish(const TickDelta& delta, const std::function<Backlog(uint64_t)>& backlog);

  /// Ground, tiles, content and answers of the tick that was just published: they take longer than its
  /// frames, and follow them.
  std::vector<Outgoing> stream(const std::function<Backlog(uint64_t)>& backlog);

  /// The replies of the tick that was just published: they follow its frames. `latency(reply)`: the stages
  /// that the reply states.
  std::vector<Outgoing> answer(const TickDelta& delta,
                               const std::function<ServerLatency(const Reply&)>& latency);

  const PublishedState& state() const { return state_; }
  const PublisherStats& stats() const { return stats_; }
  size_t clients() const { return clients_.size(); }
  const Motions& motions() const { return motions_; }
  /// For tests; null when there is no such client.
  const ClientView* view(uint64_t session) const;

 private:
  using Clients = std::map<uint64_t, ClientFeed>;
  /// Null when there is no such client.
  ClientFeed* find(uint64_t session);
  /// What the streams ask: the session's view, or null while it gets nothing.
  ClientView* reader(uint64_t session, const Backlog& backlog);
  void restart();
  void take_palette(const TickDelta& delta);
  ListedWorld listed() const;
  void count_operations(const TickDelta& delta);
  void serve_all(const TickChanges& changes, const std::function<Backlog(uint64_t)>& backlog);
  void allow_scans();
  void add(ServedPart&& part);

  PublisherConfig config_;
  PublishRates rates_;
  Workers& workers_;
  PublishedState state_;
  Motions motions_;
  Clients clients_;
  std::map<uint64_t, PartyCursor> cursors_;
  EncodeCache cache_;
  GroundStream ground_;
  TileStream tiles_;
  ContentStream content_;
  QueryStream queries_;
  ChunkPager pager_;
  SessionTurns scan_turns_;
  StatusBoard board_;
  PublisherStats stats_;
  std::vector<Outgoing> out_;
  std::vector<glm::vec3> eyes_m_;
  size_t physics_subscribers_ = 0;
};

}  // namespace scree
