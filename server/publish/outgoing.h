// What goes to clients, what waits for them, and what was sent.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/publish/limits.h"
#include "server/publish/shared_bytes.h"
#include "shared/field/coord.h"
#include "shared/operation/per_operation.h"

namespace scree {

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
  uint64_t stone_bytes = 0;
  uint64_t ground_bytes = 0;
  uint64_t tile_bytes = 0;
  uint64_t content_bytes = 0;  ///< palettes and images
  uint64_t kept_bytes = 0;
  uint64_t chunks_kept = 0;         ///< that were offered, and not sent
  OperationCounts operations;       ///< operations published
  OperationCounts operation_bytes;  ///< their encoded size
  uint64_t repairs = 0;             ///< chunks sent again because a check failed
  uint64_t resets = 0;              ///< clients that fell behind and were reset

  PublisherStats& operator+=(const PublisherStats& other);
};

/// What waits for a client, and what it may be sent beside.
struct Backlog {
  size_t bytes = 0;
  size_t soft_bytes = limits::outbox_soft_bytes;  ///< above, it does not read along
  int64_t granted_bytes = limits::bytes_free;     ///< that its address has left for it (BytesOut)

  bool reads_along() const { return bytes <= soft_bytes; }
  /// Its link takes less than limits::outbox_soft_bytes in limits::outbox_wait_s.
  bool is_slow() const { return soft_bytes < limits::outbox_soft_bytes; }
  /// Bytes that may be streamed now: by a slow link half of what may wait, so that the next frame finds room.
  int64_t room_bytes() const {
    return static_cast<int64_t>(is_slow() ? soft_bytes / 2 : soft_bytes) - static_cast<int64_t>(bytes);
  }
};

/// A chunk that a client wants.
struct WantedChunk {
  uint64_t session = 0;
  uint64_t party = 0;
  ChunkCoord chunk;
};

/// What serving some clients brings about beside what changes in them.
struct ServedPart {
  std::vector<Outgoing> out;
  PublisherStats stats;
  std::vector<ChunkCoord> used;    ///< chunks that were sent
  std::vector<WantedChunk> paged;  ///< out of memory
};

/// The way to one client: every message goes through send(), which counts it. Frames and replies are sent
/// however much room there is; streams look at the room before.
class Outlet {
 public:
  /// `party`: whose turns its work has (SessionTurns).
  explicit Outlet(uint64_t session, uint64_t party = 0) : session_(session), party_(party) {}

  uint64_t session() const { return session_; }
  uint64_t party() const { return party_; }
  uint64_t sent_bytes() const { return sent_bytes_; }

  /// A tick begins, before which so much waits for the client.
  void begin(const Backlog& backlog) {
    room_bytes_ = backlog.room_bytes();
    granted_bytes_ = backlog.granted_bytes;
    is_slow_ = backlog.is_slow();
  }
  /// Bytes that may still be streamed in this tick, by its link and by its address's budget.
  int64_t room_bytes() const { return std::min(room_bytes_, granted_bytes_); }
  /// By a slow link chunks go in parts.
  bool is_slow() const { return is_slow_; }
  /// Whether there is room for streams with budgets of their own: of a slow link, and of the address.
  bool has_room() const { return granted_bytes_ > 0 && (!is_slow_ || room_bytes_ > 0); }

  void send(SharedBytes bytes, ServedPart& part) {
    sent_bytes_ += bytes->size();
    room_bytes_ -= size_of(bytes);
    granted_bytes_ -= size_of(bytes);
    part.stats.sent_bytes += bytes->size();
    part.out.push_back({session_, std::move(bytes)});
  }

 private:
  uint64_t session_;
  uint64_t party_;
  int64_t room_bytes_ = 0;
  int64_t granted_bytes_ = 0;
  bool is_slow_ = false;
  uint64_t sent_bytes_ = 0;
};

}  // namespace scree
