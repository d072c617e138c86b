// Parts of the tables of functions (server/rules/api.h) that have a file of their own.
#pragma once

#include <span>

#include "server/rules/api.h"

namespace scree {

std::span<const ApiFunction> time_api();    ///< time, settings, materials
std::span<const ApiFunction> edit_api();    ///< requests about terrain, prefabs
std::span<const ApiFunction> query_api();   ///< questions about space
std::span<const ApiFunction> handle_api();  ///< bodies, their methods
std::span<const ApiFunction> joint_api();   ///< joints, their methods

}  // namespace scree
