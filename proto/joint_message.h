// The joints that a client learns of (proto/joint.proto).
#pragma once

#include <vector>

#include "shared/prop/joint.h"

namespace scree {

/// Joints that are new to the client or changed, and those that are gone; each ordered by id.
struct JointsMessage {
  std::vector<KnownJoint> here;
  std::vector<EndedJoint> gone;

  bool empty() const { return here.empty() && gone.empty(); }
};

}  // namespace scree
