// Values as people read them on a console.
#pragma once

#include <string>

struct lua_State;

namespace scree {

/// All values of the stack, separated by tabs; at most script_print_bytes_max. Raw: calls nothing.
std::string display_values(lua_State* lua);

}  // namespace scree
