// Objects of the host in a script's hands: userdata with a type's metatable.
#pragma once

#include <cstdint>
#include <optional>

#include "server/rules/sandbox/script_value.h"

namespace scree {

/// Nothing where the value is no handle. The type's text lives as long as the value.
std::optional<ScriptHandle> handle_at(lua_State* lua, int index);

/// The type must be made. The same handle as long as the script holds it.
void push_handle(lua_State* lua, const ScriptHandle& handle);

/// Leaves the table of a type's methods; makes the type where it is missing.
void push_methods(lua_State* lua, std::string_view type);

}  // namespace scree
