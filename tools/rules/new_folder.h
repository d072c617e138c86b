// A folder of rules to begin with: it runs, its test passes, and an editor knows what it may call.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// Refuses a folder that is there, and a name that rules cannot have.
Result<void> make_rules_folder(const std::string& folder);

}  // namespace scree
