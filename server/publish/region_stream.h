// The regions that one client is told of: all of them (proto/region.proto).
#pragma once

#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class RegionStream {
 public:
  /// All regions, where they are others than the client has; not oftener than limits::regions_wait_s.
  void serve(const ServedTick& tick, Outlet& outlet, ServedPart& part);
  /// The client has no regions any more.
  void forget() { told_.reset(); }

 private:
  std::shared_ptr<const std::vector<Region>> told_;  ///< as the client has them; null: it has none
  Tick told_at_ = 0;
};

}  // namespace scree
