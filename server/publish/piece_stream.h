// Streams to one client the pieces that it lacks, nearest first, within a budget of bytes and the room of its
// link. One thread at a time.
#pragma once

#include <cstdint>

#include "server/publish/client_view.h"
#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class PieceStream {
 public:
  /// Sends what this tick, which has poses, has room for.
  void serve(const ServedTick& tick, ClientView& view, Outlet& outlet, ServedPart& part);

 private:
  int64_t credit_bytes_ = 0;
};

}  // namespace scree
