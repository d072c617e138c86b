// The stones that lie where pieces merged, for a client that did not see it: with an edited chunk in
// which a stone lies, once all chunks that the stone touches have come as far as they will. A client that
// drops a chunk forgets its stones, and gets them again with the chunk. Nearest first; called as ClientFeed
// is.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class StoneStream {
 public:
  /// Whether the client wants any (HelloMessage::stones).
  void want(bool wanted) { wanted_ = wanted; }
  /// Notes the frame of a tick, which was sent: the client finds the stones of its merges by itself.
  void note(const ServedTick& tick, const FrameSelection& frame);
  /// From now on the client follows these chunks.
  void open(const ServedTick& tick, std::span<const ChunkCoord> chunks);
  void serve(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part);
  /// The client knows of none.
  void forget();

 private:
  std::vector<const PlacedStone*> next(const ServedTick& tick, const ClientView& view);

  bool wanted_ = false;
  int64_t credit_bytes_ = 0;
  std::unordered_map<ChunkCoord, std::set<PieceId>, CoordHash> known_;  ///< by chunks that it follows
  std::unordered_set<ChunkCoord, CoordHash> open_;                      ///< with stones that it may lack
};

}  // namespace scree
