// Which of the connections that are no sessions makes room for the next one. Values.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/doors/crowd.h"

namespace scree {

struct Outsider {
  uint64_t id = 0;  ///< the lower, the older
  Origin origin{};
  bool is_done = false;    ///< nobody waits for it: it was told why it is refused, or has no request
  bool is_silent = false;  ///< none of its bytes has come yet
};

/// Those of origins that hold more than limits::outsiders_of_an_address go first, the one that holds most;
/// then those for which nobody waits; then, of the silent ones and those that have begun to speak, whichever
/// are more. The oldest of these. So a crowd of one kind takes no places from clients of the other kind, and
/// a newcomer of its own kind has the time in which the crowd renews itself. There must be one.
const Outsider& who_leaves(std::span<const Outsider> outsiders);

}  // namespace scree
