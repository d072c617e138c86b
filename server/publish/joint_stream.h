// The joints that one client is told of: those all of whose bodies it has (proto/joint.proto).
#pragma once

#include <map>

#include "server/publish/client_view.h"
#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class JointStream {
 public:
  /// The joints that ended in the tick, and after poses, by which bodies come and go, all that changed.
  void serve(const ServedTick& tick, bool with_poses, const ClientView& view, Outlet& outlet,
             ServedPart& part);
  /// The client has no joints any more.
  void forget() {
    told_.clear();
    untold_.clear();
  }

 private:
  PublishedJoints told_;  ///< as the client has them
  PublishedJoints
      untold_;  ///< added since the last poses: a client that knows the bodies is told of their end
};

}  // namespace scree
