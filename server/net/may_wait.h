// The refusal of a client that asks for more than may wait to be answered.
#pragma once

#include <cstddef>
#include <string>

#include "server/command/refusal.h"

namespace scree {

/// `fits`: whether all of it was queued. `limit`: the name of `most` in limits.
inline tl::expected<void, Refused> may_wait(bool fits, size_t most, const std::string& what,
                                            const std::string& limit) {
  if (fits) return {};
  return refuse(Refusal::ground_waiting, "more than " + std::to_string(most) + " " + what +
                                             " asked for and not answered (limits." + limit + ")");
}

}  // namespace scree
