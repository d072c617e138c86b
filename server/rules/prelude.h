// What scripts find besides the library of the sandbox and the functions of the host, in Lua itself: vec.
#pragma once

#include <string_view>

#include "server/rules/sandbox/script.h"

namespace scree {

/// The text of the prelude. Lines that explain its functions begin with ---, as LuaLS reads them.
std::string_view rules_prelude();

/// Runs it in a new script, before the script's files. From then on places that the host writes are vecs.
Script::Ended load_prelude(Script& script, ScriptBudget& budget);

}  // namespace scree
