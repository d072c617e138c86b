// Rows of the lists that administrators get of sessions and bans (proto/access.proto).
#pragma once

#include <cstdint>
#include <string>

#include "shared/base/role.h"

namespace scree {

/// A session, as an administrator sees it.
struct SessionRow {
  uint64_t session = 0;
  std::string name;     ///< the person's
  std::string program;  ///< the client's
  std::string address;
  Role role = Role::viewer;
  uint64_t token_id = 0;  ///< 0: it came without an access token
  uint32_t joined_s = 0;  ///< seconds since it joined
  uint64_t sent_bytes = 0;
  bool encrypted = false;

  bool operator==(const SessionRow&) const = default;
};

struct BanRow {
  std::string address;
  uint64_t left_s = 0;  ///< seconds until it ends; 0: when it is lifted
  std::string reason;

  bool operator==(const BanRow&) const = default;
};

}  // namespace scree
