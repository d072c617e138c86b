// Which of its pieces one client is told to be kept (KeptPieces in proto/prop.proto).
#pragma once

#include <vector>

#include "server/publish/client_view.h"
#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class KeptStream {
 public:
  /// After poses, by which pieces come and go: those that are new to it, and those that were released.
  void serve(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part);
  /// The client has no pieces any more.
  void forget() { told_.clear(); }

 private:
  std::vector<PieceId> told_;  ///< as the client has them, ordered
};

}  // namespace scree
