// How deep a JSON text nests: trees of any depth parse, but copying one recurses, once for each level.
#pragma once

#include <string_view>

#include "shared/base/result.h"

namespace scree {

/// Refuses what nests deeper than limits::json_depth_max. Any text will do: whether it is JSON is the
/// parser's to say.
Result<void> check_json_depth(std::string_view text);

}  // namespace scree
