// Annotations by which an editor with the Lua language server knows what rules find: types/scree.lua of a
// folder, and types/tests.lua for its tests.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

std::string types_text();
std::string test_types_text();
/// Settings of the language server (.luarc.json): Lua 5.4 without what the sandbox leaves out.
std::string luarc_text();

/// Writes them into a folder of rules.
Result<void> write_types(const std::string& folder);

}  // namespace scree
