// Turns the ticks of the world into messages for each client. ClientView selects; clients with the same
// selection share the encoded bytes; slow readers get less.
//
// A client gets a frame of a tick in which something happened for it, and one every limits::heartbeat_s
// anyway, by which it sees that time goes on. The frame of its tick comes
// before a status.
//
// A slow client gets newer state, not a longer queue: chunks come to it in parts (chunk_part.h), and while
// more waits for it than its link takes soon (Backlog), it gets no poses and no streaming; above
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
#include "server/publish/chunk_offer.h"
#include "server/publish/client_view.h"
#include "server/publish/encode_cache.h"
#include "server/publish/ground_stream.h"
#include "server/publish/limits.h"
#include "server/publish/tick_clock.h"
#include "server/publish/tile_stream.h"
#include "server/world/chunk_supply.h"
#include "shared/base/workers.h"
#include "shared/operation/per_operation.h"

namespace scree {

/// As of StatusMessage::saving and saved_tick.
struct Saving {
  std::string how;
  Tick tick = 0;
  PagingStatus paging = {};
};

struct PublisherConfig {
  TerrainSource terrain;
  uint32_t tick_rate_hz = 60;
  uint32_t ticks_per_transform = 3;
  double heartbeat_s = limits::heartbeat_s;  ///< 0: a frame every tick
  std::shared_ptr<ChunkSupply> chunks = {};  ///< null: all chunks stay in memory
};

/// Bytes for a client, length prefix included.
struct Outgoing {
  uint64_t session = 0;
  SharedBytes bytes;
};

/// Counts since the start, over all clients.
struct PublisherStats {
  uint64_t sent_bytes = 0;
  uint64_t frame_bytes = 0;      ///< including transform_bytes
  uint64_t transform_bytes = 0;  ///< motions and packed poses within frames
  uint64_t chunk_bytes = 0;
  uint64_t piece_bytes = 0;
  uint64_t ground_bytes = 0;
  uint64_t tile_bytes = 0;
  uint64_t kept_bytes = 0;
  uint64_t chunks_kept = 0;         ///< that were offered, and not sent
  OperationCounts operations;       ///< operations published
  OperationCounts operation_bytes;  ///< their encoded size
  uint64_t repairs = 0;             ///< chunks sent again because a check failed
  uint64_t resets = 0;              ///< clients that fell behind and were reset

  PublisherStats& operator+=(const PublisherStats& other);
};

/// What waits for a client.
struct Backlog {
  size_t bytes = 0;
  size_t soft_bytes = limits::outbox_soft_bytes;  ///< above, it does not read along

  bool reads_along() const { return bytes <= soft_bytes; }
  /// Its link takes less than limits::outbox_soft_bytes in limits::outbox_wait_s.
  bool is_slow() const { return soft_bytes < limits::outbox_soft_bytes; }
  /// Bytes that may be streamed now: by a slow link half of what may wait, so that the next frame finds room.
  int64_t room_bytes() const {
    return static_cast<int64_t>(is_slow() ? soft_bytes / 2 : soft_bytes) - static_cast<int64_t>(bytes);
  }
};

class Publisher {
 public:
  /// `workers` outlives the publisher.
  Publisher(const PublisherConfig& config, Workers& workers);

  /// `operations`: as of ClientView; where there are any, the client gets motions, else whole poses
  /// (Frame.motions, Frame.transforms). `offers`: an offer follows, and chunks wait for it.
  void join(uint64_t session, glm::vec3 eye_m, float radius_m, size_t operations, bool offers = false);
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

  /// Sets how often the server has refused requests and sessions, for the status.
  void set_refusals(const RefusalCounts& refusals) { refusals_ = refusals; }
  /// Sets the stages of the last second's requests, for the status.
  void set_latency(const LatencyStatus& latency) { latency_ = latency; }
  /// Sets how the world is saved, for the status.
  void set_saving(Saving saving) { saving_ = std::move(saving); }
  /// Sets the eye and aim of the session's person, for other clients.
  void set_cursor(PlayerCursor cursor);
  const std::map<uint64_t, PlayerCursor>& cursors() const { return cursors_; }
  /// Why the client may not control a replay, for PlaybackMessage; empty: it may.
  void set_control_refusal(uint64_t session, const std::string& refusal);
  /// What all clients are told alike, of the last second.
  StatusMessage status() const;
  /// Whether the client gets PhysicsMessages of the ticks that have them.
  void watch(uint64_t session, bool physics);
  bool is_watched() const { return watchers_ > 0; }
  /// Eyes of all clients, by session, as of the last tick.
  const std::vector<glm::vec3>& eyes_m() const { return eyes_m_; }

  /// Takes the next tick and returns the messages for each client. `backlog(session)`: what still waits for
  /// it; called by the workers, too. A tick out of sequence is a keyframe: it replaces the state, and resets
  /// every client.
  std::vector<Outgoing> publish(const TickDelta& delta, const std::function<Backlog(uint64_t)>& backlog);

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
  struct Client {
    uint64_t session;
    ClientView view;
    int64_t chunk_credit_bytes = 0;
    int64_t piece_credit_bytes = 0;
    int64_t room_bytes = 0;  ///< that may still be streamed to it in this tick
    bool is_slow = false;    ///< so that chunks come in parts
    int next_brick = 0;      ///< of a chunk, where the next part begins
    bool stopped = false;    ///< gets no frames until it has read all that waits
    bool reset_due = false;
    Tick last_frame = 0;  ///< tick of the last frame that it got; 0: none
    uint64_t sent_bytes = 0;
    uint32_t repairs = 0;
    ChunkOffer offer{};
    bool watches = false;
    int64_t physics_credit_bytes = 0;
    std::string control_refusal{};              ///< why it may not control a replay; empty: it may
    std::optional<PlaybackMessage> playback{};  ///< as the client knows it, as the next two
    std::shared_ptr<const MarksMessage> marks{};
    std::shared_ptr<const RecordedCursorsMessage> recorded_cursors{};
    std::vector<PlayerCursor> cursors{};  ///< as the client knows them

    /// Whether a slow one still has room in this tick; others have budgets.
    bool takes_more() const { return !is_slow || room_bytes > 0; }
  };
  /// What serving some clients brings about beside what changes in them.
  struct Part {
    std::vector<Outgoing> out;
    PublisherStats stats;
    std::vector<ChunkCoord> used, paged;  ///< chunks that were sent; that are out
  };
  bool has_poses(Tick tick) const { return tick % config_.ticks_per_transform == 0; }
  void count_operations(const TickDelta& delta);
  uint32_t ticks_of(double seconds) const { return static_cast<uint32_t>(seconds * config_.tick_rate_hz); }
  void serve_all(const TickChanges& changes, const std::function<Backlog(uint64_t)>& backlog);
  void add(Part&& part);

  // ---- by any of the workers
  void serve(Client& client, const TickChanges& changes, const Backlog& backlog, Part& part);
  bool ready(Client& client, size_t backlog_bytes, Part& part);
  bool send_frame(Client& client, const TickChanges& changes, FrameScope scope, Part& part);
  bool frame_due(const Client& client, Tick tick) const;
  /// Once a second, in another tick than most others get theirs.
  bool status_due(const Client& client, Tick tick) const {
    return (tick + client.session) % config_.tick_rate_hz == 0;
  }
  void stream_chunks(Client& client, const TickChanges& changes, Part& part);
  SharedBytes whole_chunk(Client& client, ChunkCoord coord, const PublishedChunk& chunk);
  SharedBytes next_part(Client& client, ChunkCoord coord, const PublishedChunk& chunk);
  void send_kept(Client& client, const KeptMessage& kept, Part& part);
  void stream_pieces(Client& client, Part& part);
  void send_replay(Client& client, const TickDelta& delta, bool reads_along, Part& part);
  void send_playback(Client& client, const PlaybackMessage& now, Tick tick, Part& part);
  void send_cursors(Client& client, Part& part);
  void send_physics(Client& client, const PhysicsMessage& physics, Part& part);
  void send_status(Client& client, Part& part);
  static void send(Client& client, SharedBytes bytes, Part& part);

  // ---- by the owner's thread alone
  void take_chunks();
  void page_out();
  void stream_ground(const std::function<Backlog(uint64_t)>& backlog, Part& part);
  void stream_tiles(const std::function<Backlog(uint64_t)>& backlog, Part& part);

  PublisherConfig config_;
  Workers& workers_;
  PublishedState state_;
  Motions motions_;
  std::map<uint64_t, Client> clients_;
  std::map<uint64_t, PlayerCursor> cursors_;
  EncodeCache cache_;
  GroundStream ground_;
  TileStream tiles_;
  TickClock clock_;
  PublisherStats stats_;
  RefusalCounts refusals_;
  LatencyStatus latency_;
  Saving saving_;
  StatusMessage status_;  ///< of this tick
  std::vector<Outgoing> out_;
  std::vector<ChunkCoord> paged_;  ///< chunks that clients want, and that are out
  std::vector<glm::vec3> eyes_m_;
  size_t watchers_ = 0;
};

}  // namespace scree
