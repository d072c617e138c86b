// Where a connection comes from, and whether it may stay.
#pragma once

#include <optional>
#include <string>

#include "server/command/refusal.h"

namespace scree {

struct Visitor {
  std::string address;   ///< as of Door
  bool relayed = false;  ///< as of Caller
  bool at_door = true;   ///< it has a place there under `address`, which it gives back
  /// It is told so, and nothing else.
  std::optional<Refused> turned_away{};
  bool is_owner = false;  ///< as of Caller
};

}  // namespace scree
