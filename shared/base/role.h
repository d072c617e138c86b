// What a session may do on a server. The numbers are those on the wire and in access tokens; each role may do
// what those before it may.
#pragma once

#include "shared/base/kind_table.h"

namespace scree {

enum class Role : uint8_t { viewer, carver, builder, admin };

struct RoleRow {
  std::string_view name;
  std::string_view may;  ///< what it may beyond the one before
};

constexpr RoleRow row_of(Role role) {
  switch (role) {
    case Role::viewer:
      return {"viewer", "look"};
    case Role::carver:
      return {"carver", "carve"};
    case Role::builder:
      return {"builder", "fill and paint"};
    case Role::admin:
      return {"admin", "change settings, list, kick and ban"};
  }
  return {};
}

constexpr bool may_act_as(Role role, Role needed) {
  return role >= needed;
}

}  // namespace scree
