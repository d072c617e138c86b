// A client's request on its way to the world.
#pragma once

#include <cstdint>

#include "shared/operation/request.h"

namespace scree {

struct Command {
  uint64_t session = 0;  ///< session of the client; 0: the server itself
  uint32_t request = 0;  ///< the client's number of the request, returned in the reply
  Request body;

  bool operator==(const Command&) const = default;
};

}  // namespace scree
