// Everything that one client is sent: its frames and status, and in which order the streams beside them have
// their turn. A client that reads too slowly is stopped, and reset once it has read everything.
//
// serve() is called by any of the workers, one at a time for a client: it changes nothing but this object,
// the cache and its part.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "server/publish/chunk_stream.h"
#include "server/publish/client_view.h"
#include "server/publish/game_stream.h"
#include "server/publish/joint_stream.h"
#include "server/publish/kept_stream.h"
#include "server/publish/outgoing.h"
#include "server/publish/person_stream.h"
#include "server/publish/physics_feed.h"
#include "server/publish/piece_stream.h"
#include "server/publish/region_stream.h"
#include "server/publish/replay_news.h"
#include "server/publish/served_tick.h"
#include "server/publish/stone_stream.h"
#include "server/publish/store_stream.h"

namespace scree {

class ClientFeed {
 public:
  /// The view's arguments are as of ClientView.
  ClientFeed(uint64_t session, uint64_t party, glm::vec3 eye_m, float radius_m, size_t operations)
      : outlet_(session, party), view_(eye_m, radius_m, operations) {}

  ClientView& view() { return view_; }
  const ClientView& view() const { return view_; }
  Outlet& outlet() { return outlet_; }
  ChunkOffer& offer() { return chunks_.offer(); }
  ReplayNews& replay() { return replay_; }
  PhysicsFeed& physics_feed() { return physics_feed_; }
  StoreStream& store() { return store_; }
  StoneStream& stones() { return stones_; }
  GameStream& game() { return game_; }
  /// Gets no frames until it has read all that waits.
  bool stopped() const { return stopped_; }

  /// The client's copy of a chunk that it holds is wrong: it is sent again.
  void repair(ChunkCoord chunk);
  /// The next tick tells the client to forget its edits and pieces, and it begins anew.
  void reset_soon() { reset_due_ = true; }

  /// Whether the next tick may scan an interest that has changed.
  void allow_scan(bool allowed) { may_scan_ = allowed; }

  /// The messages of a tick, before which so much waits for the client.
  void serve(const ServedTick& tick, const Backlog& backlog, ServedPart& part);

 private:
  bool ready(size_t backlog_bytes, ServedPart& part);
  bool frame_due(const ServedTick& tick) const;
  bool send_frame(const ServedTick& tick, FrameScope scope, ServedPart& part);
  void send_status(const ServedTick& tick, ServedPart& part);

  Outlet outlet_;
  ClientView view_;
  ChunkStream chunks_;
  PieceStream pieces_;
  JointStream joints_;
  KeptStream kept_;
  RegionStream regions_;
  PersonStream persons_;
  ReplayNews replay_;
  PhysicsFeed physics_feed_;
  StoreStream store_;
  StoneStream stones_;
  GameStream game_;
  bool stopped_ = false;
  bool reset_due_ = false;
  bool may_scan_ = true;
  Tick last_frame_ = 0;  ///< tick of the last frame that it got; 0: none
  uint32_t repairs_ = 0;
};

}  // namespace scree
