// Who a session is, as the network side tells a host.
#pragma once

#include <cstdint>
#include <string>

#include "shared/base/role.h"

namespace scree {

struct JoinedPerson {
  uint64_t session = 0;
  std::string name{};
  Role role = Role::viewer;
  std::string team{};        ///< that the access token states; empty: none
  uint64_t token_id = 0;     ///< of the access token; 0: none
  bool meets = false;        ///< it sees who else is there, and what they say
  bool resumed = false;      ///< the connection was lost, and the session goes on
  bool administers = false;  ///< it does nothing else, and is nobody in the world
  std::string ip{};          ///< numeric; of the owner by the admin socket: words

  bool operator==(const JoinedPerson&) const = default;
};

}  // namespace scree
