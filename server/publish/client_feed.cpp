#include "server/publish/client_feed.h"

#include <algorithm>
#include <utility>

#include "proto/limits.h"

namespace scree {

namespace {

/// Bricks that may be patched: they are much, so who reads slowly gets none, and later the chunks as they are
/// then. By a slow link they have the room that is left, and by any link what the address's budget has left.
size_t patches_for(const Backlog& backlog) {
  if (!backlog.reads_along()) return 0;
  const int64_t room =
      backlog.is_slow() ? std::min(backlog.room_bytes(), backlog.granted_bytes) : backlog.granted_bytes;
  return std::min(limits::patch_bricks_max,
                  static_cast<size_t>(std::max<int64_t>(0, room)) / limits::patch_brick_bytes);
}

}  // namespace

void ClientFeed::repair(ChunkCoord chunk) {
  view_.distrust(chunk);
  ++repairs_;
}

void ClientFeed::serve(const ServedTick& tick, const Backlog& backlog, ServedPart& part) {
  if (!ready(backlog.bytes, part)) return;
  const bool reads_along = backlog.reads_along();
  outlet_.begin(backlog);
  const bool with_poses = reads_along && tick.rates.has_poses(tick.tick());
  const bool with_status = tick.rates.status_due(outlet_.session(), tick.tick());
  if (!send_frame(tick, {with_poses, patches_for(backlog), may_scan_}, part)) return;
  if (tick.changes.delta.playback) replay_.serve(tick.changes.delta, with_status, reads_along, outlet_, part);
  // Pieces first: by a slow link, chunks take all the room there is, and what merges unknown pieces comes as
  // bricks.
  if (with_poses) pieces_.serve(tick, view_, outlet_, part);
  if (reads_along) joints_.serve(tick, with_poses, view_, outlet_, part);
  if (with_poses) kept_.serve(tick, view_, outlet_, part);
  if (reads_along) regions_.serve(tick, outlet_, part);
  if (reads_along) persons_.serve(tick, with_poses, outlet_, part);
  if (reads_along) store_.serve(tick, outlet_, part);
  if (reads_along) game_.serve(tick, outlet_, part);
  if (reads_along) chunks_.serve(tick, view_, outlet_, part);
  if (reads_along) stones_.open(tick, chunks_.followed());
  if (with_poses) stones_.serve(tick, view_, outlet_, part);
  if (with_status) send_status(tick, part);
  if (reads_along) physics_feed_.serve(tick, view_, outlet_, part);
}

/// Whether the client gets a frame in this tick. A stopped client that has read everything starts again.
bool ClientFeed::ready(size_t backlog_bytes, ServedPart& part) {
  if (!stopped_ && backlog_bytes > limits::outbox_resync_bytes) stopped_ = true;
  if (stopped_) {
    if (backlog_bytes != 0) return false;
    stopped_ = false;
    reset_due_ = true;
    ++part.stats.resets;
  }
  if (reset_due_) {
    reset_due_ = false;
    view_.reset();
    chunks_.offer().forget();
    joints_.forget();
    kept_.forget();
    stones_.forget();
    regions_.forget();
    game_.forget();
    persons_.forget();
    last_frame_ = 0;
    outlet_.send(share(ResetMessage{}), part);
  }
  return true;
}

/// Whether the client gets a frame of this tick though nothing happened for it.
bool ClientFeed::frame_due(const ServedTick& tick) const {
  return last_frame_ == 0 || tick.tick() >= last_frame_ + tick.rates.ticks_of(tick.rates.heartbeat_s) ||
         tick.rates.status_due(outlet_.session(), tick.tick());
}

bool ClientFeed::send_frame(const ServedTick& tick, FrameScope scope, ServedPart& part) {
  FrameSelection selection = view_.select_frame(tick.changes, scope);
  stones_.note(tick, selection);
  if (selection.is_empty() && !frame_due(tick)) return true;
  last_frame_ = tick.tick();
  const EncodeCache::Frame& frame = tick.cache.frame(std::move(selection), tick.changes);
  if (frame.bytes->size() > limits::message_bytes_max) {
    // A frame of this size must not cross the wire: the client is reset, and gets the state in small
    // messages.
    reset_due_ = true;
    return false;
  }
  part.stats.frame_bytes += frame.bytes->size();
  part.stats.transform_bytes += frame.transform_bytes;
  outlet_.send(frame.bytes, part);
  return true;
}

void ClientFeed::send_status(const ServedTick& tick, ServedPart& part) {
  StatusMessage status = tick.status;
  status.sent_bytes = outlet_.sent_bytes();
  status.repairs = repairs_;
  status.chunks_waiting = static_cast<uint32_t>(view_.chunks_waiting());
  outlet_.send(share(status), part);
}

}  // namespace scree
