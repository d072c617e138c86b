// What a session may do on a server. The numbers are those on the wire and in access tokens; each role may do
// what those of a lower rank may.
#pragma once

#include "shared/base/kind_table.h"

namespace scree {

enum class Role : uint8_t { viewer, carver, builder, admin, director };

struct RoleRow {
  std::string_view name;
  int rank;              ///< each may do what those of lower ranks may
  std::string_view may;  ///< what it may beyond those
};

constexpr RoleRow row_of(Role role) {
  switch (role) {
    case Role::viewer:
      return {"viewer", 0, "look"};
    case Role::carver:
      return {"carver", 1, "carve, push and break"};
    case Role::builder:
      return {"builder", 2, "fill and paint"};
    case Role::admin:
      return {"admin", 4, "change settings, list, kick and ban"};
    case Role::director:
      return {"director", 3, "add, move and remove props"};
  }
  return {};
}

constexpr bool may_act_as(Role role, Role needed) {
  return traits_of(role).rank >= traits_of(needed).rank;
}

}  // namespace scree
